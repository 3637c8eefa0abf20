#include "route_server/network/network_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

// hall of 20 m, office of 10 m, ring of 8 m.
class NetworkRegistryTest : public testing::Test {
 protected:
  void SetUp() override {
    Put(1, "hall", 20.0);
    Put(2, "office", 10.0);
    Put(3, "ring", 8.0);
    Restart();
  }
  void Restart() {
    registry_.reset();
    auto store = store::NetworkStore::Open(folder_ / "joints");
    ASSERT_TRUE(store) << store.error().message;
    auto registry = NetworkRegistry::Open(AgentId("server"), std::move(*store), routes_);
    ASSERT_TRUE(registry) << registry.error().message;
    registry_ = std::move(*registry);
  }
  route::RouteInfo Put(unsigned number, const std::string& name, double length_m,
                       std::uint64_t teaching = 1,
                       route::Standing standing = route::Standing::kActive,
                       std::uint32_t edition = 0) {
    route::RouteInfo info = test::InfoOf(test::KeyNumber(number, teaching),
                                         test::PiecesOf(test::KeyNumber(number, teaching), 2),
                                         route::RouteState::kComplete);
    info.name = name;
    info.length_m = length_m;
    info.standing = standing;
    info.edition = edition;
    EXPECT_TRUE(routes_.PutRoute(info));
    if (registry_) registry_->Note(info);
    return info;
  }
  exchange::NetworkReply Edit(const std::string& words, std::uint64_t request = 0) {
    return registry_->Change({AgentId("desk-p7"), request == 0 ? ++requests_ : request, words},
                             1000);
  }
  std::vector<std::string> Done(const std::string& words) {
    const auto reply = Edit(words);
    EXPECT_EQ(reply.error, "") << words;
    return reply.lines;
  }
  std::string Refused(const std::string& words) {
    const auto reply = Edit(words);
    EXPECT_THAT(reply.lines, IsEmpty()) << words;
    return reply.error;
  }
  exchange::NetworkReply Ask(const std::string& words, std::uint32_t first = 0) {
    const auto reply = registry_->Answer({AgentId("desk"), 7, words, first});
    EXPECT_TRUE(exchange::CheckBounds(reply));
    EXPECT_EQ(reply.request, 7U);
    return reply;
  }
  std::vector<std::string> Asked(const std::string& words = "") {
    const auto reply = Ask(words);
    EXPECT_EQ(reply.error, "") << words;
    return reply.lines;
  }

  static route::RouteKey Key(unsigned number, std::uint64_t teaching = 1) {
    return test::KeyNumber(number, teaching);
  }
  // Returns what it adds, "taken: .." if it is made at once.
  std::string Propose(const Meeting& meeting, double take_from = 2.0) {
    const auto proposed = registry_->Propose(meeting, take_from, 1000);
    EXPECT_TRUE(proposed) << proposed.error().message;
    if (!proposed || !*proposed) return "";
    return ((*proposed)->taken ? "taken: " : "") + (*proposed)->line;
  }

  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<NetworkRegistry> registry_;
  std::uint64_t requests_ = 100;
};

TEST_F(NetworkRegistryTest, JoinedRoutesMakeAWayThatIsAMissionsOrders) {
  EXPECT_THAT(Ask("way hall@2 office@8").error, HasSubstr("no way leads from hall@2 to office@8"));
  EXPECT_THAT(Done("join hall@12.0 office@0.0"), ElementsAre("join hall@12 office@0"));
  EXPECT_THAT(Asked("way hall@2 office@8"), ElementsAre("follow hall 2..12", "follow office 0..8"));
  EXPECT_THAT(Asked(),
              ElementsAre("route hall 20.00", "route office 10.00", "join hall@12 office@0"));
  Restart();
  EXPECT_THAT(Asked("way hall@2 office@8"), SizeIs(2)) << "it is durable";
  EXPECT_THAT(Asked("way hall@2 hall@2"), IsEmpty()) << "it is there";
  EXPECT_THAT(Asked("way ring@2 ring@3"), ElementsAre("follow ring 2..3")) << "joined to none";
  EXPECT_THAT(Done("part office@0 hall@12"), ElementsAre("join hall@12 office@0"));
  EXPECT_THAT(Refused("part office@0 hall@12"), HasSubstr("no junction of office@0 and hall@12"));
  EXPECT_THAT(Asked(), IsEmpty());
}

TEST_F(NetworkRegistryTest, HomeIsTheNearestPlaceOfThatKind) {
  (void)Done("join hall@12 office@0");
  EXPECT_THAT(Ask("way hall@2 home").error, HasSubstr("no place is a home"));
  EXPECT_THAT(Done("name far office@9 home"), ElementsAre("name far office@9 home"));
  EXPECT_THAT(Done("name near hall@15 home"), ElementsAre("name near hall@15 home"));
  (void)Done("name bay hall@4");
  EXPECT_THAT(Asked("way hall@2 home"), ElementsAre("follow hall 2..15"));
  EXPECT_THAT(Asked("way office@1 home"), ElementsAre("follow office 1..9"))
      << "no way to the other";
  EXPECT_THAT(Asked("way hall@15 home"), IsEmpty()) << "it is there";
  Restart();
  EXPECT_THAT(Asked("way hall@2 home"), ElementsAre("follow hall 2..15")) << "it is durable";
  (void)Done("close hall 13..14");
  EXPECT_THAT(Asked("way hall@2 home"), ElementsAre("follow hall 2..12", "follow office 0..9"));
  EXPECT_THAT(Ask("way ring@2 home").error, HasSubstr("no way leads from ring@2"));
  (void)Done("name home hall@4");
  EXPECT_THAT(Asked("way hall@2 home"), ElementsAre("follow hall 2..4")) << "one is called so";
}

TEST_F(NetworkRegistryTest, WhatIsProposedIsNoWayUntilItIsConfirmed) {
  EXPECT_EQ(Propose({Key(1), Key(2), 12.0, 0.4, 3.0, 0.05, 0.93}),
            "proposed join hall@12 office@0.4 both heading 2.9 confidence 0.93");
  EXPECT_EQ(registry_->open_proposals(), 1U);
  Restart();
  EXPECT_THAT(Asked(), ElementsAre("route hall 20.00", "route office 10.00",
                                   "proposed join hall@12 office@0.4 both heading 2.9 confidence "
                                   "0.93"));
  EXPECT_THAT(Ask("way hall@2 office@8").error, HasSubstr("no way leads"));
  EXPECT_THAT(Refused("confirm hall@12 office@2"),
              HasSubstr("no junction of hall@12 and office@2 is"));
  EXPECT_THAT(Done("confirm office@0 hall@12"),
              ElementsAre("join hall@12 office@0.4 both heading 2.9"));
  EXPECT_THAT(Asked("way hall@2 office@8"), SizeIs(2));
  EXPECT_EQ(registry_->open_proposals(), 0U);
  Done("part hall@12 office@0.4");
  EXPECT_EQ(Propose({Key(1), Key(2), 12.0, 0.4, 3.0, 0.05, 0.93}), "") << "it had its word";
  Restart();
  EXPECT_THAT(Asked(), IsEmpty());
}

TEST_F(NetworkRegistryTest, WhatWasRefusedIsNotProposedAgainOfTheseRevisions) {
  Propose({Key(1), Key(2), 12.0, 0.4, 3.0, {}, 0.93});
  EXPECT_THAT(Done("refuse hall@12.3 office@0.7"),
              ElementsAre("proposed join hall@12 office@0.4 both confidence 0.93"));
  Restart();
  EXPECT_EQ(Propose({Key(1), Key(2), 12.9, 1.2, 3.0, {}, 0.99}), "");
  EXPECT_EQ(Propose({Key(2), Key(1), 0.0, 11.1, 3.0, {}, 0.99}), "") << "nor from the other's side";
  EXPECT_THAT(Asked(), IsEmpty());
  EXPECT_NE(Propose({Key(1), Key(2), 17.0, 0.4, 3.0, {}, 0.93}), "") << "another place";
  // A new revision is another one, until the one of before is followed again.
  Put(1, "hall", 20.0, 1, route::Standing::kRetired, 2);
  Put(1, "hall", 20.0, 2, route::Standing::kActive, 2);
  EXPECT_THAT(Asked(), Not(Contains(HasSubstr("proposed"))));
  EXPECT_EQ(Propose({Key(1), Key(2), 17.0, 4.4, 3.0, {}, 0.93}), "") << "not followed";
  EXPECT_NE(Propose({Key(1, 2), Key(2), 12.0, 0.4, 3.0, {}, 0.93}), "");
}

TEST_F(NetworkRegistryTest, NoneIsProposedBesideAJunctionAndOneSideOfAPairIsEnough) {
  Done("join hall@12 office@0");
  EXPECT_EQ(Propose({Key(1), Key(2), 13.0, 0.9, 3.0, {}, 0.93}), "");
  EXPECT_NE(Propose({Key(3), Key(2), 1.0, 6.0, 3.0, {}, 0.93}), "");
  EXPECT_EQ(Propose({Key(2), Key(3), 6.8, 1.7, 3.0, {}, 0.95}), "");
  EXPECT_EQ(Propose({Key(2), Key(3), 3.0, 0.0, 5.0, {}, 0.95}), "")
      << "a longer section that has it in its middle";
  Done("join ring@1 office@6");
  EXPECT_THAT(Asked(), Not(Contains(HasSubstr("proposed")))) << "an operator made it himself";
}

TEST_F(NetworkRegistryTest, RoutesThatPassAreFoundFromBothSidesAsFarAsTheyRunTogether) {
  Done("join hall@2 ring@4");
  // From hall's 9 m and office's 0 m on, for 8 m: proposed three metres into that.
  Propose({Key(1), Key(2), 12.0, 3.0, 8.0, {}, 0.93});
  const std::string proposed = " proposed join hall@12 office@3 both confidence 0.93";
  for (int run = 0; run < 2; ++run) {
    EXPECT_THAT(Asked("passing hall@9"), ElementsAre("at hall@9", "passes office@0" + proposed));
    EXPECT_THAT(Asked("passing hall@17"), ElementsAre("at hall@17", "passes office@8" + proposed));
    EXPECT_THAT(Asked("passing office@7.5"),
                ElementsAre("at office@7.5", "passes hall@16.5" + proposed));
    EXPECT_THAT(Asked("passing hall@8.9"), ElementsAre("at hall@8.9"));
    EXPECT_THAT(Asked("passing hall@17.1"), ElementsAre("at hall@17.1"));
    Restart();
  }
  Done("confirm hall@12 office@3");
  EXPECT_THAT(Asked("passing hall@17"),
              ElementsAre("at hall@17", "passes office@8 join hall@12 office@3 both"));
  // How far those run together whom an operator has joined, nobody has said.
  EXPECT_THAT(Asked("passing ring@5.5"),
              ElementsAre("at ring@5.5", "passes hall@3.5 join hall@2 ring@4"));
  EXPECT_THAT(Asked("passing ring@6.1"), ElementsAre("at ring@6.1"));
  Done("name bay ring@3");
  EXPECT_THAT(Asked("passing bay"), ElementsAre("at ring@3", "passes hall@1 join hall@2 ring@4"));
}

TEST_F(NetworkRegistryTest, OfWhatPassesNothingIsSaidTwiceNorOfOtherRevisionsThanAreFollowed) {
  Done("join hall@12 office@0");
  Done("join hall@13 office@1 both");
  Done("join ring@8 ring@0");
  EXPECT_THAT(Asked("passing hall@12.5"), SizeIs(2)) << "one junction is enough";
  EXPECT_THAT(Asked("passing hall@10.5"),
              ElementsAre("at hall@10.5", "passes office@0 join hall@12 office@0"))
      << "not before it begins";
  EXPECT_THAT(Asked("passing ring@0.5"),
              ElementsAre("at ring@0.5", "passes ring@8 join ring@8 ring@0"))
      << "it comes by again";
  EXPECT_THAT(Ask("passing attic@1").error, HasSubstr("there is no route 'attic'"));
  EXPECT_THAT(Ask("passing hall@21").error, HasSubstr("there is no 21 m on it"));
  EXPECT_THAT(Ask("passing attic").error, HasSubstr("no place is called 'attic'"));
  EXPECT_THAT(Ask("passing hall@1 office@1").error, HasSubstr("'hall@1 office' is no route"));
  Put(1, "hall", 20.0, 1, route::Standing::kStaged, 2);
  Put(1, "hall", 20.0, 2, route::Standing::kActive, 2);
  EXPECT_THAT(Asked("passing hall@12.5"), SizeIs(1));
  EXPECT_THAT(Ask("passing hall@1@12.5").error,
              HasSubstr("hall@1@12.5 is on a revision that robots do not follow"));
}

TEST_F(NetworkRegistryTest, OfARouteWhoseTeachingWasCutOffItIsSaid) {
  route::RouteInfo attic =
      test::InfoOf(Key(4), test::PiecesOf(Key(4), 2), route::RouteState::kComplete);
  attic.name = "attic";
  attic.cut_off = true;
  ASSERT_TRUE(routes_.PutRoute(attic));
  registry_->Note(attic);
  const auto says_so =
      AllOf(HasSubstr("the server has no active revision of route 'attic'"),
            HasSubstr("its teaching was cut off, and robots follow no revision of it"));
  EXPECT_THAT(Ask("passing attic@1").error, says_so);
  EXPECT_THAT(Ask("way attic@1 hall@2").error, says_so);
  EXPECT_THAT(Refused("join hall@12 attic@0"), says_so);
  EXPECT_THAT(Refused("name bay attic@2"), says_so);
}

TEST_F(NetworkRegistryTest, ARouteThatComesBackIsToLeadFromItsEndToItsBeginning) {
  EXPECT_EQ(Propose({Key(3), Key(3), 0.0, 7.5, 0.5, -0.1, 0.97}),
            "proposed join ring@7.5 ring@0 both heading 5.7 confidence 0.97");
}

TEST_F(NetworkRegistryTest, AllThatAreSureAreConfirmedAtOnceAndTheOthersRefused) {
  Propose({Key(1), Key(2), 12.0, 0.4, 3.0, {}, 0.93});
  Propose({Key(1), Key(3), 3.0, 1.0, 2.0, {}, 0.7});
  Propose({Key(2), Key(3), 8.0, 5.0, 2.0, {}, 0.9});
  EXPECT_THAT(Done("confirm all above 0.9"),
              ElementsAre("join hall@12 office@0.4 both", "join office@8 ring@5 both"));
  EXPECT_THAT(Done("confirm all above 0.9"), IsEmpty());
  EXPECT_THAT(Done("refuse all"), ElementsAre("proposed join hall@3 ring@1 both confidence 0.70"));
  Restart();
  EXPECT_THAT(Asked(), Not(Contains(HasSubstr("proposed"))));
  EXPECT_THAT(Asked("way hall@2 ring@7"), SizeIs(3));
}

TEST_F(NetworkRegistryTest, SureOnesAreTakenAtOnceWhereThatIsWanted) {
  EXPECT_EQ(Propose({Key(1), Key(2), 12.0, 0.4, 3.0, {}, 0.93}, 0.9),
            "taken: proposed join hall@12 office@0.4 both confidence 0.93");
  EXPECT_EQ(Propose({Key(1), Key(3), 3.0, 1.0, 2.0, {}, 0.89}, 0.9),
            "proposed join hall@3 ring@1 both confidence 0.89");
  Restart();
  EXPECT_THAT(Asked("way hall@2 office@8"), SizeIs(2));
  EXPECT_EQ(registry_->open_proposals(), 1U);
}

TEST_F(NetworkRegistryTest, OfAPairOnlySoManyAreProposed) {
  for (std::size_t i = 0; i < NetworkRegistry::kMostOfAPair + 3; ++i) {
    Propose({Key(1), Key(1), 0.3 * static_cast<double>(i), 19.0 - 2.5 * (i % 7), 0.1, {}, 0.9});
  }
  EXPECT_LE(registry_->open_proposals(), NetworkRegistry::kMostOfAPair);
  EXPECT_GE(registry_->open_proposals(), 4U);
}

TEST_F(NetworkRegistryTest, WhatWasLookedAtIsRememberedUntilItIsDeleted) {
  EXPECT_FALSE(registry_->WasSearched(Key(1)));
  registry_->MarkSearched(Key(1));
  EXPECT_TRUE(registry_->WasSearched(Key(1)));
  ASSERT_TRUE(registry_->SaveSearched());
  Propose({Key(1), Key(2), 12.0, 0.4, 3.0, {}, 0.93});
  Restart();
  EXPECT_TRUE(registry_->WasSearched(Key(1)));
  Put(1, "hall", 20.0, 1, route::Standing::kDeleted, 2);
  EXPECT_FALSE(registry_->WasSearched(Key(1)));
  Restart();
  EXPECT_FALSE(registry_->WasSearched(Key(1)));
  EXPECT_EQ(registry_->open_proposals(), 0U);
}

TEST_F(NetworkRegistryTest, TheSameJunctionIsMadeOnce) {
  Done("join hall@12 office@0");
  EXPECT_THAT(Done("join hall@12.03 office@0 both offset 0.1,-0.2 heading 3"),
              ElementsAre("join hall@12 office@0 both offset 0.1,-0.2 heading 3.0"));
  EXPECT_THAT(Asked(), SizeIs(3));
  EXPECT_THAT(Asked("way office@0 hall@13"), ElementsAre("follow hall 12..13"));
}

TEST_F(NetworkRegistryTest, AnEditAskedForAgainIsCarriedOutOnce) {
  Done("join hall@12 office@0");
  const auto parted = Edit("part hall@12 office@0", 42);
  EXPECT_EQ(parted.error, "");
  EXPECT_EQ(Edit("part hall@12 office@0", 42), parted);
  EXPECT_NE(Edit("part hall@12 office@0", 43).error, "");
}

TEST_F(NetworkRegistryTest, WhatIsDoneIsToldOnceAndByWhom) {
  const auto made = [this] {
    std::vector<std::string> told;
    for (const network::Change& change : registry_->TakeMade()) {
      EXPECT_EQ(change.at_unix_ms, 1000);
      EXPECT_EQ(change.by, "desk");
      told.push_back(change.what);
    }
    return told;
  };
  (void)Done("join hall@12 office@0 both");
  (void)Edit("join hall@12 office@0 both", requests_);
  EXPECT_THAT(made(), ElementsAre("join hall@12 office@0 both")) << "it was asked for twice";
  (void)Done("close hall 3..7");
  (void)Done("open hall");
  (void)Done("name bay office@8");
  (void)Done("forget bay");
  (void)Done("part office@0 hall@12");
  (void)Refused("part office@0 hall@12");
  EXPECT_THAT(made(), ElementsAre("close hall 3..7", "open hall", "name bay office@8", "forget bay",
                                  "part hall@12 office@0"));
  ASSERT_TRUE(registry_->Propose(
      {.a = Key(1), .b = Key(2), .at_a_m = 5.0, .at_b_m = 1.0, .length_m = 3.0, .confidence = 0.8},
      2.0, 1000));
  EXPECT_THAT(made(), IsEmpty()) << "it is no more than proposed";
  (void)Done("refuse all");
  EXPECT_THAT(made(), ElementsAre("refuse hall@5 office@1"));
}

TEST_F(NetworkRegistryTest, WhatIsClosedIsAvoidedOrNamedUntilItIsOpened) {
  Done("join hall@12 office@0");
  Done("join ring@8 ring@0");
  EXPECT_THAT(Done("close office 3..7"), ElementsAre("close office 3..7"));
  Restart();
  EXPECT_THAT(Ask("way hall@2 office@8").error,
              AllOf(HasSubstr("closed"), HasSubstr("office 3..7")));
  EXPECT_THAT(Asked("way hall@2 office@3"), SizeIs(2));
  EXPECT_THAT(Asked("way ring@6 ring@1"), ElementsAre("follow ring 6..8", "follow ring 0..1"));
  EXPECT_THAT(Done("open office"), IsEmpty());
  EXPECT_THAT(Asked("way hall@2 office@8"), SizeIs(2));
  EXPECT_THAT(Done("limit office 4.. speed 0.5"), ElementsAre("limit office 4.. speed 0.5"));
  EXPECT_THAT(Asked("way hall@2 office@8"), ElementsAre("follow hall 2..12", "follow office 0..4",
                                                        "follow office 4..8 speed 0.5"));
}

TEST_F(NetworkRegistryTest, AJunctionOfARevisionThatIsNotFollowedIsNotUsed) {
  Done("join hall@12 office@0");
  Done("close hall 13..14");
  Put(1, "hall", 20.0, 1, route::Standing::kRetired, 1);
  Put(1, "hall", 21.0, 2, route::Standing::kActive, 1);
  EXPECT_THAT(Asked(), ElementsAre("route hall 21.00", "route office 10.00",
                                   "unused join hall@1@12 office@0", "close hall 13..14"));
  EXPECT_THAT(Ask("way hall@2 office@8").error, HasSubstr("no way"));
  EXPECT_THAT(Ask("way hall@1@2 office@8").error,
              HasSubstr("hall@1@2 is on a revision that robots do not follow"));
  EXPECT_THAT(Ask("way hall@2 hall@20").error, HasSubstr("13..14")) << "closed it stays";
  Done("join hall@13 office@0");
  EXPECT_THAT(Asked("way hall@2 office@8"), ElementsAre("follow hall 2..13", "follow office 0..8"));
  EXPECT_THAT(Done("part hall@1@12 office@0"), ElementsAre("join hall@1@12 office@0"));
}

TEST_F(NetworkRegistryTest, AJunctionOfADeletedRouteIsPartedAsItIsListed) {
  Done("join hall@12 office@0");
  Put(2, "office", 10.0, 1, route::Standing::kDeleted, 1);
  EXPECT_THAT(Asked(), ElementsAre("route hall 20.00", "unused join hall@12 office@1@0"));
  EXPECT_THAT(Done("part hall@12 office@1@0"), SizeIs(1));
  EXPECT_THAT(Asked(), IsEmpty());
}

TEST_F(NetworkRegistryTest, RoutesOfOneNameAreToldApartByTheirIds) {
  Done("join hall@12 office@0");
  Put(4, "hall", 5.0);
  const std::string id = test::KeyNumber(1).route.value();
  EXPECT_THAT(Asked("way " + id + "@2 office@8"),
              ElementsAre("follow " + id + " 2..12", "follow office 0..8"));
  EXPECT_THAT(Ask("way hall@2 office@8").error, HasSubstr("hall"));
  EXPECT_THAT(Refused("close hall"), HasSubstr("hall"));
}

TEST_F(NetworkRegistryTest, ARobotsWayBeginsWhereItLastSaidThatItStands) {
  Done("join hall@12 office@0");
  EXPECT_THAT(Ask("way robot1 office@8").error, HasSubstr("'robot1' has not said where"));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  status.place = {.key = test::KeyNumber(1), .along_m = 2.004};
  registry_->Hear(status);
  status.place.reset();
  registry_->Hear(status);
  EXPECT_THAT(Asked("way robot1 office@8"), ElementsAre("follow hall 2..12", "follow office 0..8"));
  status.place = {.key = test::KeyNumber(9), .along_m = 1.0};
  registry_->Hear(status);
  EXPECT_THAT(Ask("way robot1 office@8").error, HasSubstr("do not follow, where robot1 may stand"));
}

TEST_F(NetworkRegistryTest, APlaceIsGoneToByItsName) {
  Done("join hall@12 office@0");
  EXPECT_THAT(Done("name loading-bay office@8.0"), ElementsAre("name loading-bay office@8"));
  Done("name door ring@1");
  Restart();
  EXPECT_THAT(Asked(), testing::IsSupersetOf(
                           {"route ring 8.00", "name door ring@1", "name loading-bay office@8"}));
  EXPECT_THAT(Asked("way hall@2 loading-bay"),
              ElementsAre("follow hall 2..12", "follow office 0..8"));
  Done("name door office@1");
  EXPECT_THAT(Asked(), testing::Not(testing::Contains(HasSubstr("ring"))))
      << "nothing is there now";
  Done("name loading-bay office@3");
  Done("name gate hall@11");
  EXPECT_THAT(Asked("way gate loading-bay"),
              ElementsAre("follow hall 11..12", "follow office 0..3"));
  exchange::AgentStatus status;
  status.agent = AgentId("gate");
  status.role = exchange::AgentRole::kFollower;
  status.place = {.key = test::KeyNumber(1), .along_m = 2.0};
  registry_->Hear(status);
  EXPECT_THAT(Asked("way gate loading-bay").front(), "follow hall 2..12") << "a robot of that name";

  Put(2, "office", 12.0, 2, route::Standing::kActive, 1);
  Put(2, "office", 10.0, 1, route::Standing::kRetired, 1);
  EXPECT_THAT(Asked(), testing::Contains(HasSubstr("unused name loading-bay office@")));
  EXPECT_THAT(Ask("way hall@2 loading-bay").error, HasSubstr("robots do not follow"));
  EXPECT_THAT(Done("forget loading-bay"), ElementsAre(HasSubstr("name loading-bay office@")));
  EXPECT_THAT(Ask("way hall@2 loading-bay").error, HasSubstr("no place is called 'loading-bay'"));
  EXPECT_THAT(Refused("forget loading-bay"), HasSubstr("no place is called 'loading-bay'"));
  EXPECT_THAT(Refused("name attic attic@2"), HasSubstr("there is no route 'attic'"));
}

TEST_F(NetworkRegistryTest, WhatCannotBeIsRefusedInWords) {
  EXPECT_THAT(Refused("join hall@12 attic@0"), HasSubstr("there is no route 'attic'"));
  EXPECT_THAT(Refused("join hall@21 office@0"), HasSubstr("'hall' is 20.00 m long"));
  EXPECT_THAT(Refused("join hall@2 hall@2.01"), HasSubstr("another place"));
  EXPECT_THAT(Refused("close hall 20.."), HasSubstr("beyond it"));
  Put(5, "blind", 0.0);
  EXPECT_THAT(Refused("join hall@12 blind@0"), HasSubstr("'blind' was taught without odometry"));
  EXPECT_THAT(Refused("dance"), HasSubstr("expected 'join"));
  EXPECT_THAT(Ask("way hall@2").error, HasSubstr("expected ROUTE@METRES"));
  EXPECT_THAT(Ask("way hall@2 office@11").error, HasSubstr("'office' is 10.00 m long"));
  EXPECT_THAT(Refused(std::string(512, 'x')), SizeIs(exchange::kMaxLineBytes));
  EXPECT_THAT(Asked(), IsEmpty());
}

TEST_F(NetworkRegistryTest, ALongListIsGivenInPages) {
  for (int i = 0; i < 1100; ++i) {
    Done(fmt::format("join hall@{:.2f} office@{:.2f}", 0.1 * (i % 190), 0.1 * (i / 190)));
  }
  const auto first = Ask("");
  EXPECT_THAT(first.lines, SizeIs(exchange::kMaxNetworkLines));
  ASSERT_EQ(first.next, exchange::kMaxNetworkLines);
  const auto rest = Ask("", first.next);
  EXPECT_EQ(first.lines.size() + rest.lines.size(), 1102U);
  EXPECT_EQ(rest.next, 0U);
  EXPECT_THAT(Ask("", 5000).lines, IsEmpty());
}

// Between hall's 4 m and its 10 m one may go round over ring, which is 2 m and a junction more.
TEST_F(NetworkRegistryTest, TheLongerWayIsTakenWhereTheShorterOneWasLostLately) {
  Done("join hall@14 office@8");
  Done("join hall@4 ring@0");
  Done("join ring@8 hall@10");
  const std::vector<std::string> straight{"follow hall 4..14", "follow office 8..9"};
  const std::vector<std::string> round{"follow ring 0..8", "follow hall 10..14",
                                       "follow office 8..9"};
  EXPECT_EQ(Asked("way hall@4 office@9"), straight);
  const std::uint64_t changes = registry_->changes();
  registry_->followed().Hear({AgentId("robot1"), Key(1), {{0, 1, 0}, {1, 1, 1}}}, 1000);
  registry_->followed().Hear({AgentId("robot1"), Key(2, 7), {{1, 1, 1}}}, 1000);  // not known
  ASSERT_TRUE(registry_->KeepFollowed(1000));
  EXPECT_EQ(Asked("way hall@4 office@9"), round);
  EXPECT_THAT(Asked(), Contains("lost hall 5..10 1 of 1 cost 2.3"));
  EXPECT_EQ(registry_->changes(), changes) << "who is under way goes on";
  Restart();
  ASSERT_TRUE(registry_->KeepFollowed(1000));
  EXPECT_EQ(Asked("way hall@4 office@9"), round) << "it is durable";
  Done("close ring");
  EXPECT_EQ(Asked("way hall@4 office@9"), straight) << "where there is no other";
  Done("open ring");
  const auto week_ms = static_cast<std::int64_t>(FollowedLately::kHalfAfter_ms);
  ASSERT_TRUE(registry_->KeepFollowed(1000 + 10 * week_ms));
  EXPECT_EQ(Asked("way hall@4 office@9"), straight) << "it was not lately";
  EXPECT_THAT(Asked(), Not(Contains(HasSubstr("lost "))));
}

TEST_F(NetworkRegistryTest, WhereRobotsWereLostOnARevisionThatIsNotFollowedNobodyGoesRoundIt) {
  Done("join hall@14 office@8");
  registry_->followed().Hear({AgentId("robot1"), Key(2), {{1, 1, 1}}}, 1000);
  ASSERT_TRUE(registry_->KeepFollowed(1000));
  EXPECT_THAT(Asked(), Contains("lost office 5..10 1 of 1 cost 2.3"));
  Put(2, "office", 10.0, 1, route::Standing::kRetired, 1);
  Put(2, "office", 10.0, 2, route::Standing::kActive, 1);
  EXPECT_THAT(Asked(), Not(Contains(HasSubstr("lost "))));
}

TEST_F(NetworkRegistryTest, ASectionThatIsDrivenBackwardsTooIsNarrow) {
  EXPECT_THAT(Done("back office 2.."), ElementsAre("back office 2..", "narrow office 2..10"));
  EXPECT_THAT(Asked("way office@9 office@3"), ElementsAre("follow office backwards 9..3"));
  EXPECT_THAT(Refused("back office 12.."), HasSubstr("12 m is beyond it"));
  Restart();
  EXPECT_THAT(Asked("way office@9 office@3"), ElementsAre("follow office backwards 9..3"));
  EXPECT_THAT(Done("ahead office"), IsEmpty());
  EXPECT_THAT(Ask("way office@9 office@3").error, HasSubstr("no way leads"));
}

TEST_F(NetworkRegistryTest, AWayTurnsRoundWhereAJunctionLeadsToTheOppositeDirection) {
  Done("join hall@20 office@1 heading 180");
  EXPECT_THAT(Asked("way hall@3 office@4"),
              ElementsAre("follow hall 3..20", "turn 180", "follow office 1..4"));
  EXPECT_THAT(Asked("way hall@20 office@4"), ElementsAre("turn 180", "follow office 1..4"));
}

}  // namespace
}  // namespace trailcast::server
