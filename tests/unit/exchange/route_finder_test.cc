#include "services/exchange/route_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::exchange {
namespace {

using route::RouteInfo;
using route::RouteState;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::SizeIs;

const AgentId kSelf("follower");
const AgentId kServer("server");

RouteInfo Info(const std::string& name, std::uint32_t revision, std::int64_t taught,
               RouteState state) {
  RouteInfo info;
  info.key = {RouteId(std::string(32, 'a')), TeachingId(revision)};
  info.name = name;
  info.revision = RevisionNumber(revision);
  info.taught_unix_ms = taught;
  info.state = state;
  return info;
}

class RouteFinderTest : public testing::Test {
 protected:
  // Asks, and returns the request's number.
  std::uint64_t Ask(milliseconds at) {
    const auto messages = finder_.Tick(start_ + at);
    return messages.empty() ? 0 : std::get<CatalogRequest>(messages.front()).request;
  }
  RouteFinder finder_{kSelf, "hall"};
  RouteFinder::Time start_{};
};

TEST_F(RouteFinderTest, AsksForTheNameAgainEachSecondUntilItIsFound) {
  const auto first = finder_.Tick(start_);
  ASSERT_THAT(first, SizeIs(1));
  EXPECT_EQ(std::get<CatalogRequest>(first.front()), (CatalogRequest{kSelf, 1, {.name = "hall"}}));
  EXPECT_EQ(Ask(milliseconds(500)), 0U);
  EXPECT_EQ(Ask(milliseconds(1000)), 2U);
  const auto info = Info("hall", 1, 5, RouteState::kComplete);
  finder_.Handle(CatalogReply{kServer, kSelf, 2, {.routes = {info}}, {}, ""});
  EXPECT_EQ(finder_.found(), info);
  EXPECT_EQ(Ask(milliseconds(9000)), 0U);
}

TEST_F(RouteFinderTest, ARouteThatOneServerLacksMayBeAnothers) {
  const AgentId other("server-2");
  Ask(milliseconds(0));
  EXPECT_FALSE(finder_.IsUnknownTo({kServer, other}));
  finder_.Handle(CatalogReply{kServer, kSelf, 1, {}, {}, ""});
  EXPECT_FALSE(finder_.IsUnknownTo({kServer, other}));
  EXPECT_TRUE(finder_.IsUnknownTo({kServer}));
  finder_.Handle(CatalogReply{other, kSelf, 1, {}, {}, ""});
  EXPECT_TRUE(finder_.IsUnknownTo({kServer, other}));
}

TEST_F(RouteFinderTest, TakesTheNewestCompleteRevision) {
  Ask(milliseconds(0));
  finder_.Handle(CatalogReply{kServer,
                              kSelf,
                              1,
                              {.routes = {Info("hall", 3, 30, RouteState::kTeaching),
                                          Info("hall", 2, 20, RouteState::kComplete),
                                          Info("hall", 1, 10, RouteState::kComplete)}},
                              {},
                              ""});
  EXPECT_EQ(finder_.found()->revision.value(), 2U);
}

TEST_F(RouteFinderTest, ANameThatTwoScoutsGaveIsNotFoundWithoutSayingWhose) {
  RouteInfo ours = Info("hall", 1, 10, RouteState::kComplete);
  ours.scout = AgentId("a");
  RouteInfo theirs = Info("hall", 1, 20, RouteState::kComplete);
  theirs.key.route = RouteId(std::string(32, 'b'));
  theirs.scout = AgentId("b");
  Ask(milliseconds(0));
  const CatalogReply reply{kServer, kSelf, 1, {.routes = {theirs, ours}}, {}, ""};
  finder_.Handle(reply);
  EXPECT_FALSE(finder_.found());
  EXPECT_THAT(finder_.rivals(), ElementsAre(ours, theirs));
  RouteFinder of_scout(kSelf, "hall", {.scout = "a"});
  (void)of_scout.Tick(start_);
  of_scout.Handle(reply);
  EXPECT_EQ(of_scout.found(), ours);
  RouteInfo retired = theirs;
  retired.standing = route::Standing::kRetired;
  retired.edition = 1;
  EXPECT_THAT(FindRivals({retired, ours}), testing::IsEmpty()) << "of it none may be followed";
}

TEST_F(RouteFinderTest, ChoosesTheOneThatIsMeantOrSaysThatSeveralAre) {
  const RouteInfo ours = Info("hall", 1, 10, RouteState::kComplete);
  RouteInfo theirs = ours;
  theirs.key.route = RouteId(std::string(32, 'b'));
  EXPECT_EQ(*ChooseMeant("hall", {ours}), ours);
  EXPECT_EQ(*ChooseMeant("hall", {}), std::nullopt);
  const auto either = ChooseMeant("hall", {ours, theirs});
  ASSERT_FALSE(either);
  EXPECT_EQ(either.error().code, ErrorCode::kConflict);
}

TEST_F(RouteFinderTest, FindsARouteByTheBeginningOfItsId) {
  const RouteInfo ours = Info("hall", 1, 10, RouteState::kComplete);
  RouteInfo theirs = ours;
  theirs.key.route = RouteId(std::string(32, 'b'));
  RouteFinder by_id(kSelf, "bbbbbbb");
  EXPECT_EQ(std::get<CatalogRequest>(by_id.Tick(start_).front()).query.name, "bbbbbbb");
  by_id.Handle(RouteAnnouncement{AgentId("scout"), ours});
  EXPECT_FALSE(by_id.announced());
  by_id.Handle(RouteAnnouncement{AgentId("scout"), theirs});
  EXPECT_EQ(by_id.announced(), theirs);
  by_id.Handle(CatalogReply{kServer, kSelf, 1, {.routes = {theirs}}, {}, ""});
  EXPECT_EQ(by_id.found(), theirs);
}

TEST_F(RouteFinderTest, WhatIsHeldBackIsTakenByItsNumberOnly) {
  RouteInfo cut_off = Info("hall", 2, 20, RouteState::kComplete);
  cut_off.cut_off = true;
  RouteInfo to_review = Info("hall", 3, 30, RouteState::kComplete);
  to_review.to_review = true;
  const RouteInfo before = Info("hall", 1, 10, RouteState::kComplete);
  EXPECT_EQ(ChooseRoute({to_review, cut_off, before}), before);
  EXPECT_EQ(ChooseRoute({to_review, cut_off}), std::nullopt);
  EXPECT_EQ(ChooseRoute({to_review, cut_off, before}, {.number = 2}), cut_off);
  EXPECT_EQ(ChooseRoute({to_review, cut_off, before}, {.number = 3}), to_review);
}

TEST_F(RouteFinderTest, TellsThatTheServerDoesNotKnowTheRouteAndWhichItKnows) {
  Ask(milliseconds(0));
  finder_.Handle(CatalogReply{kServer, kSelf, 1, {}, {"hall2", "mall"}, ""});
  ASSERT_TRUE(finder_.unknown());
  EXPECT_EQ(finder_.unknown()->server, kServer);
  EXPECT_THAT(finder_.unknown()->similar_names, ElementsAre("hall2", "mall"));
  EXPECT_FALSE(finder_.found());
  EXPECT_EQ(Ask(milliseconds(1000)), 2U) << "it may still be taught";
}

TEST_F(RouteFinderTest, IgnoresRepliesToOthersAndToNothing) {
  const auto info = Info("hall", 1, 5, RouteState::kComplete);
  finder_.Handle(CatalogReply{kServer, kSelf, 1, {.routes = {info}}, {}, ""});
  Ask(milliseconds(0));
  finder_.Handle(CatalogReply{kServer, AgentId("other"), 1, {.routes = {info}}, {}, ""});
  finder_.Handle(CatalogReply{kServer, kSelf, 7, {.routes = {info}}, {}, ""});
  EXPECT_FALSE(finder_.found());
}

TEST_F(RouteFinderTest, KeepsTheLatestAnnouncementOfTheNameAlone) {
  finder_.Handle(RouteAnnouncement{AgentId("scout"), Info("mall", 1, 5, RouteState::kTeaching)});
  EXPECT_FALSE(finder_.announced());
  finder_.Handle(RouteAnnouncement{AgentId("scout"), Info("hall", 1, 5, RouteState::kTeaching)});
  auto grown = Info("hall", 1, 5, RouteState::kTeaching);
  grown.segment_count = 4;
  finder_.Handle(RouteAnnouncement{AgentId("scout"), grown});
  EXPECT_EQ(finder_.announced(), grown);
}

TEST(ChooseRouteTest, HasNothingToChooseFromNothing) { EXPECT_FALSE(ChooseRoute({})); }

RouteInfo Standing(RouteInfo info, route::Standing standing) {
  info.standing = standing;
  info.edition = 1;
  return info;
}

TEST(ChooseRoute, TakesTheActiveRevisionThoughThereAreNewerOnes) {
  const auto old = Standing(Info("hall", 1, 10, RouteState::kComplete), route::Standing::kActive);
  EXPECT_EQ(ChooseRoute({Info("hall", 3, 30, RouteState::kTeaching), old,
                         Info("hall", 2, 20, RouteState::kComplete)}),
            old);
}

TEST(ChooseRoute, TakesNothingOfARouteWhoseOperatorActivatedNone) {
  const auto retired =
      Standing(Info("hall", 1, 10, RouteState::kComplete), route::Standing::kRetired);
  EXPECT_EQ(ChooseRoute({retired, Info("hall", 2, 20, RouteState::kComplete)}), std::nullopt);
}

TEST(ChooseRoute, TakesTheRevisionThatIsNamedOrTheNewestToBeHeldInAdvance) {
  const auto old = Standing(Info("hall", 1, 10, RouteState::kComplete), route::Standing::kActive);
  const auto retired =
      Standing(Info("hall", 4, 40, RouteState::kComplete), route::Standing::kRetired);
  const auto deleted =
      Standing(Info("hall", 5, 50, RouteState::kComplete), route::Standing::kDeleted);
  const auto staged = Info("hall", 2, 20, RouteState::kComplete);
  const std::vector<RouteInfo> all{Info("hall", 3, 30, RouteState::kTeaching), old, staged, retired,
                                   deleted};
  EXPECT_EQ(ChooseRoute(all, {.newest = true}), staged);
  EXPECT_EQ(ChooseRoute(all, {.number = 4}), retired);
  EXPECT_EQ(ChooseRoute(all, {.number = 5}), std::nullopt);
}

// As a scout lays aside what it discards, in its own store.
TEST(ChooseRoute, TakesWhatWasRetiredWithoutAnOperatorByItsNumberOnly) {
  RouteInfo retired = Info("hall", 2, 20, RouteState::kComplete);
  retired.standing = route::Standing::kRetired;
  const RouteInfo before = Info("hall", 1, 10, RouteState::kComplete);
  EXPECT_EQ(ChooseRoute({retired, before}), before);
  EXPECT_EQ(ChooseRoute({retired, before}, {.number = 2}), retired);
}

TEST(NotMeant, SaysWhatThereIsAndWhatToDo) {
  RouteInfo review = Info("hall", 1, 10, RouteState::kComplete);
  review.to_review = true;
  RouteInfo cut_off = Info("hall", 2, 20, RouteState::kComplete);
  cut_off.cut_off = true;
  const std::string first = route::ShortIds().Of(review);
  const std::string second = route::ShortIds().Of(cut_off);
  const Error reviewed = NotMeant("server 'barn'", "hall", {review});
  EXPECT_EQ(reviewed.code, ErrorCode::kNotFound);
  EXPECT_EQ(reviewed.message, "server 'barn' has no active revision of route 'hall'; it has " +
                                  first + " (to be reviewed): 'trailcast routes activate " + first +
                                  "' has robots follow it, and " + first +
                                  " in place of the name means it alone");
  EXPECT_EQ(NotMeant("server 'barn'", "hall", {review, cut_off}).message,
            "server 'barn' has no active revision of route 'hall'; it has " + second +
                " (cut off), " + first +
                " (to be reviewed): its teaching was cut off, and robots follow no revision of it; "
                "teach it again, or finish it with 'trailcast-agent teach --unfinished go-on'; "
                "'trailcast routes activate " +
                second + "' has robots follow it as far as it goes, and " + second +
                " in place of the name means it alone");
  EXPECT_EQ(
      NotMeant("robot.db", "hall", {cut_off}, {.number = 7, .scout = "jo"}).message,
      "robot.db has no revision 7 of route 'hall' of scout 'jo'; it has " + second + " (cut off)");
  const std::vector many(6, Standing(review, route::Standing::kRetired));
  EXPECT_THAT(NotMeantText("robot.db", "hall", many), testing::EndsWith("(retired), .."));
}

TEST_F(RouteFinderTest, AServerThatHasRevisionsCountsMoreThanOneThatHasNone) {
  Ask(milliseconds(0));
  const AgentId other("other");
  RouteInfo cut_off = Info("hall", 1, 10, RouteState::kComplete);
  cut_off.cut_off = true;
  finder_.Handle(CatalogReply{other, kSelf, 1, {.routes = {cut_off}}, {}, ""});
  finder_.Handle(CatalogReply{kServer, kSelf, 1, {}, {"mall"}, ""});
  ASSERT_TRUE(finder_.unknown());
  EXPECT_EQ(finder_.unknown()->server, other);
  EXPECT_THAT(finder_.unknown()->others, ElementsAre(cut_off));
  EXPECT_TRUE(finder_.IsUnknownTo({kServer, other}));
  Ask(milliseconds(1000));
  finder_.Handle(CatalogReply{other, kSelf, 2, {}, {}, ""});
  EXPECT_TRUE(finder_.unknown()->others.empty()) << "it has been deleted there meanwhile";
}

TEST_F(RouteFinderTest, TellsNoneActiveFromNoneThere) {
  Ask(milliseconds(0));
  const auto retired =
      Standing(Info("hall", 1, 10, RouteState::kComplete), route::Standing::kRetired);
  finder_.Handle(CatalogReply{kServer, kSelf, 1, {.routes = {retired}}, {}, ""});
  EXPECT_FALSE(finder_.found());
  ASSERT_TRUE(finder_.unknown());
  EXPECT_THAT(finder_.unknown()->others, ElementsAre(retired));
}

}  // namespace
}  // namespace trailcast::exchange
