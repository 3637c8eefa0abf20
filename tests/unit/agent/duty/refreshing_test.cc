#include "agent/duty/refreshing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "services/route/digest.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using test::WalkDevice;
using testing::Contains;
using testing::HasSubstr;

constexpr int kTaughtFrames = 150;
constexpr int kFollowedFrames = 220;

class RefreshingTest : public testing::Test {
 protected:
  void SetUp() override {
    swarm_.StartServer();
    WalkDevice scout(kTaughtFrames);
    const auto taught = swarm_.Teach(scout, swarm_.ScoutNamed("scout"), true);
    ASSERT_TRUE(taught) << taught.error().message;
  }
  void TearDown() override {
    swarm_.StopServer();
    EXPECT_TRUE(swarm_.server_result);
  }
  ReplayOutcome Follow(const std::string& name, bool take_experience) {
    WalkDevice device(kFollowedFrames);
    FollowerOptions options = swarm_.FollowerNamed(name);
    options.how.session.take_experience = take_experience;
    auto outcome = swarm_.Replay(device, options, true);
    EXPECT_TRUE(outcome) << outcome.error().message;
    EXPECT_TRUE(outcome->success) << outcome->reason;
    return *std::move(outcome);
  }
  // All is found, but for the first of each so many features.
  refresh::Visit VisitMissing(store::RouteStore& store, const route::RouteInfo& route,
                              std::size_t one_in) {
    refresh::Visit visit;
    for (std::uint32_t i = 0; i < route.segment_count; ++i) {
      const auto segment = route::Open(store.ReadSegment(route.key, SegmentIndex(i)).value());
      refresh::SegmentVisit& each = visit.segments.emplace_back();
      each.index = SegmentIndex(i);
      for (std::size_t k = 0; k < segment->features.size(); ++k) {
        each.features.push_back(k % one_in == 0 ? refresh::Sought::kMissed
                                                : refresh::Sought::kFound);
      }
    }
    return visit;
  }

  test::Swarm swarm_;
};

TEST_F(RefreshingTest, WhoHasArrivedTellsWhatItMetIfItWasToNoteIt) {
  EXPECT_FALSE(Follow("plain", false).visit);
  const ReplayOutcome outcome = Follow("keen", true);
  ASSERT_TRUE(outcome.visit);
  ASSERT_TRUE(outcome.followed);
  EXPECT_EQ(outcome.followed->name, "hall");
}

TEST_F(RefreshingTest, WhatIsRefreshedReachesTheServerToBeReviewedAndNobodyFollowsItYet) {
  const ReplayOutcome outcome = Follow("keen", true);
  ASSERT_TRUE(outcome.followed);
  auto store = swarm_.OpenStore("keen");
  const auto refreshed =
      StoreRefreshed(AgentId("keen"), *outcome.followed, VisitMissing(*store, *outcome.followed, 3),
                     Refreshing::kReview, *store);
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  EXPECT_EQ(refreshed->key.route, outcome.followed->key.route);
  EXPECT_EQ(refreshed->revision.value(), 2U);
  EXPECT_TRUE(refreshed->to_review);
  EXPECT_DOUBLE_EQ(refreshed->length_m, outcome.followed->length_m);
  EXPECT_EQ(refreshed->refreshes.value(), 1U);
  EXPECT_THAT(refreshed->tags, Contains("refreshed"));
  EXPECT_THAT(refreshed->description, HasSubstr("revision 1 refreshed by keen"));

  ScoutLinkOptions link;
  link.agent = AgentId("keen");
  link.store_file = swarm_.StoreFile("keen").string();
  const auto sent = DeliverBacklog(link, std::move(store), swarm_.Join(exchange::ScoutTopics()));
  ASSERT_TRUE(sent) << sent.error().message;
  EXPECT_EQ(Follow("other", true).followed->revision.value(), 1U);
  swarm_.StopServer();  // whose store it is
  const auto there = swarm_.OpenStore("server")->FindRevisions(refreshed->key.route).value();
  ASSERT_EQ(there.size(), 2U);
  for (const route::RouteInfo& each : there) {
    EXPECT_EQ(each.state, route::RouteState::kComplete);
    const bool first = each.revision.value() == 1;
    EXPECT_EQ(each.standing, first ? route::Standing::kActive : route::Standing::kStaged);
    EXPECT_EQ(each.to_review, !first);
  }
}

TEST_F(RefreshingTest, WhereNobodyIsToBeAskedTheServerHasRobotsFollowIt) {
  const ReplayOutcome outcome = Follow("keen", true);
  ASSERT_TRUE(outcome.followed);
  auto store = swarm_.OpenStore("keen");
  const auto refreshed =
      StoreRefreshed(AgentId("keen"), *outcome.followed, VisitMissing(*store, *outcome.followed, 3),
                     Refreshing::kAuto, *store);
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  ScoutLinkOptions link;
  link.agent = AgentId("keen");
  link.store_file = swarm_.StoreFile("keen").string();
  const auto sent = DeliverBacklog(link, std::move(store), swarm_.Join(exchange::ScoutTopics()));
  ASSERT_TRUE(sent) << sent.error().message;
  // The server compares it after its receipts.
  std::uint32_t followed = 1;
  for (int i = 0; i < 20 && followed == 1; ++i) {
    followed = Follow("other", true).followed->revision.value();
  }
  EXPECT_EQ(followed, 2U);
}

TEST_F(RefreshingTest, ARouteThatIsAsItWasTaughtIsLeftAlone) {
  const ReplayOutcome outcome = Follow("keen", true);
  ASSERT_TRUE(outcome.followed);
  const auto store = swarm_.OpenStore("keen");
  const auto refreshed =
      StoreRefreshed(AgentId("keen"), *outcome.followed,
                     VisitMissing(*store, *outcome.followed, 1000), Refreshing::kAuto, *store);
  ASSERT_FALSE(refreshed);
  EXPECT_EQ(refreshed.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(refreshed.error().message, HasSubstr("as it was taught"));
  EXPECT_EQ(store->ListRoutes().value().size(), 1U);
}

TEST_F(RefreshingTest, AVisitThatIsNotBelievedLeavesTheRouteAlone) {
  const ReplayOutcome outcome = Follow("keen", true);
  ASSERT_TRUE(outcome.followed);
  const auto store = swarm_.OpenStore("keen");
  const auto refreshed =
      StoreRefreshed(AgentId("keen"), *outcome.followed, VisitMissing(*store, *outcome.followed, 1),
                     Refreshing::kAuto, *store);
  ASSERT_FALSE(refreshed);
  EXPECT_THAT(refreshed.error().message, HasSubstr("nothing is learnt"));
  EXPECT_EQ(store->ListRoutes().value().size(), 1U);
}

}  // namespace
}  // namespace trailcast::agent
