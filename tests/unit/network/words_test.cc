#include "services/network/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::network {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string Why(const std::string& words) {
  const auto edit = ParseEdit(words);
  EXPECT_FALSE(edit) << words;
  return edit ? "" : edit.error().message;
}

// Returns what an edit has brought about as a server lists it.
std::string Listed(const std::string& words) {
  const auto edit = ParseEdit(words);
  if (!edit) return edit.error().message;
  if (edit->kind == Edit::Kind::kName) return ToText(edit->named);
  return edit->kind == Edit::Kind::kJoin ? ToText(edit->junction) : ToText(edit->condition);
}

TEST(NetworkWords, AnEditIsListedAsItWasGiven) {
  for (const char* words :
       {"join hall@12 office@0", "join hall@2@12.25 office@0 both",
        "join hall@12 office@0 both offset 0.1,-0.25 heading 3.5",
        "join hall@12 office@0 heading 3.5", "close hall", "close hall 3..7", "close hall 3..",
        "back hall", "back hall 3..7", "close hall 0..7", "limit hall 3..7 speed 0.5",
        "limit hall 3.. speed 0.5 cost 2", "limit a3f9c21 cost 0.5", "name loading-bay office@8"}) {
    EXPECT_EQ(Listed(words), words);
  }
  EXPECT_EQ(Listed("  join   hall@12.0 office@0.00  "), "join hall@12 office@0");
  EXPECT_EQ(Listed("close hall ..7"), "close hall 0..7");
  const auto part = ParseEdit("part hall@12 office@0");
  ASSERT_TRUE(part);
  EXPECT_EQ(part->kind, Edit::Kind::kPart);
  EXPECT_EQ(part->junction.from, (Place{"hall", 12.0}));
  const auto narrow = ParseEdit("narrow hall 3..7 back 10..14");
  ASSERT_TRUE(narrow);
  EXPECT_EQ(narrow->kind, Edit::Kind::kNarrow);
  EXPECT_EQ(narrow->lane, (Lane{{{"hall", 3.0, 7.0}, {"back", 10.0, 14.0}}}));
  EXPECT_EQ(ToText(narrow->lane), "narrow hall 3..7 back 10..14");
  EXPECT_THAT(Why("narrow hall"), HasSubstr("FROM..TO, both"));
  EXPECT_THAT(Why("narrow hall 3.."), HasSubstr("FROM..TO, both"));
  const network::Listed taken = ParseListed("narrow hall 3..7, taken by robot1 robot2");
  ASSERT_TRUE(taken.edit);
  EXPECT_EQ(taken.edit->lane.parts.size(), 1U);
  EXPECT_EQ(taken.taken_by, (std::vector<std::string>{"robot1", "robot2"}));
  EXPECT_EQ(ParseEdit("wide hall 3..7")->kind, Edit::Kind::kWide);
  EXPECT_EQ(ParseEdit("vacate hall")->kind, Edit::Kind::kVacate);
  const auto forget = ParseEdit("forget loading-bay");
  ASSERT_TRUE(forget);
  EXPECT_EQ(forget->kind, Edit::Kind::kForget);
  EXPECT_EQ(forget->named.name, "loading-bay");
}

TEST(NetworkWords, WhatIsNotUnderstoodIsNamed) {
  EXPECT_THAT(Why(""), HasSubstr("expected 'join PLACE PLACE"));
  EXPECT_THAT(Why("dance hall"), HasSubstr("'dance': expected 'join"));
  EXPECT_THAT(Why("join hall office@1"), HasSubstr("'hall': expected ROUTE@METRES"));
  EXPECT_THAT(Why("join hall@1"), HasSubstr("the end comes too soon: expected ROUTE@METRES"));
  EXPECT_THAT(Why("join hall@1 hall@1"), HasSubstr("another place"));
  EXPECT_THAT(Why("join hall@-1 hall@1"), HasSubstr("'hall@-1'"));
  EXPECT_THAT(Why("join hall@nan hall@1"), HasSubstr("'hall@nan'"));
  EXPECT_THAT(Why("join @1 hall@1"), HasSubstr("'@1'"));
  EXPECT_THAT(Why("join hall@2 hall@1 offset 3"), HasSubstr("'3': expected AHEAD,LEFT"));
  EXPECT_THAT(Why("join hall@2 hall@1 heading west"), HasSubstr("'west': expected degrees"));
  EXPECT_THAT(Why("join hall@2 hall@1 twice"), HasSubstr("'twice'"));
  EXPECT_THAT(Why("part hall@2 hall@1 both"), HasSubstr("'both': expected nothing more"));
  EXPECT_THAT(Why("close"), HasSubstr("a route"));
  EXPECT_THAT(Why("close hall 7..3"), HasSubstr("'7..3': expected FROM..TO"));
  EXPECT_THAT(Why("open hall 3..7 speed 1"), HasSubstr("'speed'"));
  EXPECT_THAT(Why("limit hall 3..7 speed 2"), HasSubstr("'2': expected times the taught speed"));
  EXPECT_THAT(Why("limit hall cost 0"), HasSubstr("'0': expected how many metres"));
  EXPECT_THAT(Why("name"), HasSubstr("or a name"));
  EXPECT_THAT(Why("name bay"), HasSubstr("the end comes too soon: expected ROUTE@METRES"));
  EXPECT_THAT(Why("name hall@3 office@8"),
              HasSubstr("'hall@3': expected what the place is called"));
  EXPECT_THAT(Why("name loading bay office@8"), HasSubstr("'bay'"));
  EXPECT_THAT(Why("name " + std::string(65, 'x') + " office@8"), HasSubstr("up to 64"));
  EXPECT_THAT(Why("forget bay office@8"), HasSubstr("nothing more"));
  EXPECT_THAT(Why("name dock office@8 away"),
              HasSubstr("'away': expected 'home', 'dock' or nothing more"));
  EXPECT_THAT(Why("name dock office@8 home home"), HasSubstr("expected 'dock' or nothing more"));
  EXPECT_THAT(Why("name dock office@8 dock home"), HasSubstr("expected nothing more"));
  EXPECT_THAT(Why("charge"), HasSubstr("expected 'below PERCENT [until PERCENT]' or 'never'"));
  EXPECT_THAT(Why("charge below 0"), HasSubstr("'0': expected per cent of a battery, 1 to 99"));
  EXPECT_THAT(Why("charge below 40 until 40"),
              HasSubstr("'40': expected per cent of a battery, 41"));
  EXPECT_THAT(Why("charge below 20 until 101"), HasSubstr("'101': expected"));
  EXPECT_THAT(Why("charge never again"), HasSubstr("'again': expected nothing more"));
}

TEST(NetworkWords, RobotsChargeAtDocksBelowALimit) {
  const auto usual = ParseEdit("charge below 20");
  ASSERT_TRUE(usual && usual->charge);
  EXPECT_EQ(ToText(usual->charge), "charge below 20 until 90");
  const auto high = ParseEdit("charge below 95");
  ASSERT_TRUE(high && high->charge);
  EXPECT_EQ(high->charge->until_percent, 96);
  const auto never = ParseEdit("charge never");
  ASSERT_TRUE(never);
  EXPECT_EQ(ToText(never->charge), "charge never");
  const auto dock = ParseListed("name dock1 office@8 home dock, taken by robot1 robot2");
  ASSERT_TRUE(dock.edit);
  EXPECT_EQ(ToText(dock.edit->named), "name dock1 office@8 home dock");
  EXPECT_THAT(dock.taken_by, ElementsAre("robot1", "robot2"));
  const auto charges = ParseListed(ToText(Charging{"robot1", "charges at dock1"})).charging;
  EXPECT_EQ(charges, (Charging{"robot1", "charges at dock1"}));
  EXPECT_FALSE(ParseListed("charging").charging);
}

TEST(NetworkWords, ANamedPlaceMayBeAHome) {
  const auto edit = ParseEdit("name dock office@8 home");
  ASSERT_TRUE(edit) << edit.error().message;
  EXPECT_TRUE(edit->named.home);
  EXPECT_EQ(ToText(edit->named), "name dock office@8 home");
  const auto other = ParseListed("name bay office@8");
  ASSERT_TRUE(other.edit);
  EXPECT_FALSE(other.edit->named.home);
}

TEST(NetworkWords, AProposedJunctionIsConfirmedOrRefusedByItsPlacesOrAsOneOfAll) {
  const auto one = ParseEdit("confirm hall@12 office@0.4");
  ASSERT_TRUE(one);
  EXPECT_EQ(one->kind, Edit::Kind::kConfirm);
  EXPECT_EQ(one->junction.to, (Place{"office", 0.4}));
  EXPECT_FALSE(one->all);
  const auto sure = ParseEdit("confirm all above 0.9");
  ASSERT_TRUE(sure && sure->all);
  EXPECT_EQ(sure->all->least, 0.9);
  EXPECT_EQ(sure->all->most, 1.0);
  const auto unsure = ParseEdit("refuse all below 0.8");
  ASSERT_TRUE(unsure && unsure->all);
  EXPECT_EQ(unsure->kind, Edit::Kind::kRefuse);
  EXPECT_EQ(unsure->all->least, 0.0);
  EXPECT_EQ(unsure->all->most, 0.8);
  EXPECT_TRUE(ParseEdit("refuse all"));
  EXPECT_THAT(Why("confirm all below 0.9"), HasSubstr("'below': expected 'above F'"));
  EXPECT_THAT(Why("refuse all below 1.1"), HasSubstr("'1.1': expected how sure"));
  EXPECT_THAT(Why("confirm all above 0.9 please"), HasSubstr("'please'"));
  EXPECT_THAT(Why("confirm hall@12"), HasSubstr("the end comes too soon: expected ROUTE@METRES"));
  EXPECT_THAT(Why("refuse hall@12 office@0 both"), HasSubstr("nothing more"));
}

TEST(NetworkWords, AProposalIsListedAsTheJunctionThatItWouldMakeAndNoSurerThanItIs) {
  const Proposal proposal{{{"hall", 12.3}, {"office", 0.4}, true, Lie{.turn_rad = 0.05}}, 0.9999};
  const std::string line = ToText(proposal);
  EXPECT_EQ(line, "proposed join hall@12.3 office@0.4 both heading 2.9 confidence 0.99");
  const auto listed = ParseListed(line);
  ASSERT_TRUE(listed.proposal);
  EXPECT_FALSE(listed.edit);
  EXPECT_EQ(ToText(*listed.proposal), line);
  for (const char* other :
       {"proposed join hall@12.3 office@0.4", "proposed close hall confidence 1",
        "proposed join hall@1 hall@2 confidence 7"}) {
    const auto not_one = ParseListed(other);
    EXPECT_FALSE(not_one.proposal || not_one.edit || not_one.route) << other;
  }
}

TEST(NetworkWords, WhereRobotsWereLostIsListedAndNoEdit) {
  const LostSection lost{"hall", 5.0, 10.0, 7.0, 1.8, 1.8};
  const std::string line = ToText(lost);
  EXPECT_EQ(line, "lost hall 5..10 1.8 of 7 cost 1.8");
  EXPECT_EQ(Describe(lost), "lost hall 5..10 1.8 of 7 times lately, a metre counts as 1.8");
  const auto listed = ParseListed(line);
  EXPECT_EQ(listed.lost, lost);
  EXPECT_FALSE(listed.edit);
  for (const char* other :
       {"lost hall 5..10", "lost hall 5..10 1 in 7 cost 2", "lost hall 5..10 1 of 7 cost 0.5",
        "lost hall 5..10 1 of 7 8 cost 2", "lost  cost 2"}) {
    const auto not_one = ParseListed(other);
    EXPECT_FALSE(not_one.lost || not_one.edit || not_one.route) << other;
  }
}

TEST(NetworkWords, AWayIsAskedForBetweenPlacesNamedOnesOrFromARobot) {
  const auto places = ParseQuestion("way hall@2@1.5 office@8");
  ASSERT_TRUE(places);
  EXPECT_EQ(places->from, (Goal{.place = {"hall@2", 1.5}}));
  EXPECT_EQ(places->to, (Goal{.place = {"office", 8.0}}));
  const auto named = ParseQuestion("way robot1 loading-bay");
  ASSERT_TRUE(named);
  EXPECT_EQ(named->from, (Goal{.name = "robot1"}));
  EXPECT_EQ(named->to, (Goal{.name = "loading-bay"}));
  for (const char* wrong : {"", "way", "way hall@2", "way hall@2 office@", "way hall@2 office@8 x",
                            "away hall@2 office@8"}) {
    EXPECT_FALSE(ParseQuestion(wrong)) << wrong;
  }
}

class Amending : public testing::Test {
 protected:
  void Edit(const std::string& words) {
    conditions_ = Amended(std::move(conditions_), ParseEdit(words).value());
  }
  std::vector<std::string> Texts() {
    std::vector<std::string> texts;
    for (const Condition& condition : conditions_) texts.push_back(ToText(condition));
    return texts;
  }
  std::vector<Condition> conditions_;
};

TEST_F(Amending, AtEachPlaceTheLastWordHolds) {
  Edit("close hall 3..7");
  Edit("close hall 5..9");
  EXPECT_THAT(Texts(), ElementsAre("close hall 3..5", "close hall 5..9"));
  Edit("open hall 4..6");
  EXPECT_THAT(Texts(), ElementsAre("close hall 3..4", "close hall 6..9"));
  Edit("limit hall speed 0.5");
  Edit("close office");
  Edit("open hall");
  EXPECT_THAT(Texts(), ElementsAre("limit hall speed 0.5", "close office"));
  Edit("limit hall 2..3");
  EXPECT_THAT(Texts(),
              ElementsAre("limit hall 0..2 speed 0.5", "limit hall 3.. speed 0.5", "close office"));
  Edit("back hall 1..4");
  Edit("back hall 3..6");
  Edit("ahead hall 5..9");
  EXPECT_THAT(Texts(), ElementsAre("limit hall 0..2 speed 0.5", "limit hall 3.. speed 0.5",
                                   "close office", "back hall 1..3", "back hall 3..5"));
  Edit("open hall");
  Edit("limit hall");
  Edit("ahead hall");
  Edit("open office");
  EXPECT_THAT(Texts(), IsEmpty());
}

}  // namespace
}  // namespace trailcast::network
