#include "agent/follow/next_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "agent/follow/follower.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using test::WalkDevice;
using testing::HasSubstr;

constexpr int kTaughtWalk = 150;
constexpr double kJunction_m = 0.6;
// 0.1 m before the junction.
constexpr int kBeforeJunction = 25;
constexpr int kWaitsAtMost = 5000;  // frames

// This is what a walk elsewhere looks like.
class ElsewhereDevice : public WalkDevice {
 public:
  using WalkDevice::WalkDevice;
  Result<std::optional<Observation>> Next() override {
    auto seen = WalkDevice::Next();
    if (seen && *seen) std::reverse((*seen)->image.pixels.begin(), (*seen)->image.pixels.end());
    return seen;
  }
};

// Two routes along the same walk, and a robot that changes over from the one to the other on
// the way.
class NextPathTest : public testing::Test {
 protected:
  void TeachInto(const std::string& agent, const std::string& route, bool with_server = false) {
    WalkDevice scout(kTaughtWalk);
    ScoutOptions options = swarm_.ScoutNamed(agent);
    options.route = route;
    const auto summary = swarm_.Teach(scout, options, with_server);
    ASSERT_TRUE(summary) << summary.error().message;
  }
  FollowerOptions Along(const std::string& route) {
    FollowerOptions options = swarm_.FollowerNamed("robot");
    options.link.route = route;
    return options;
  }
  // As far as the junction, and on along that route; before the junction it stands until it knows
  // that.
  FollowerOptions AlongHallThen(const std::string& route) {
    FollowerOptions options = Along("hall");
    options.end_m = [] { return kJunction_m; };
    options.next = [this, route](const auto& lens) -> FollowerOptions::Next {
      if (next_ != nullptr || !lens) return std::nullopt;
      HowToFollow how;
      how.session.lens = lens;
      auto next =
          std::make_unique<NextPath>(device_, RouteWish{0, route, {}, kJunction_m}, KnownPath(how));
      next_ = next.get();
      return next;
    };
    device_.before_frame = [this](int frame) {
      const bool waits = frame == kBeforeJunction && waits_for_next_ && !next_->ready();
      if (waits && ++waited_ < kWaitsAtMost) --device_.next;
      return Result<void>{};
    };
    return options;
  }
  Result<ReplayOutcome> GoOn(std::unique_ptr<NextPath> next) {
    FollowerOptions options = Along("office");
    options.link.begin_m = kJunction_m;
    return Replay(device_, options, swarm_.OpenStore("robot"), nullptr, std::move(next));
  }

  test::Swarm swarm_;
  WalkDevice device_{220};
  NextPath* next_ = nullptr;
  bool waits_for_next_ = true;
  int waited_ = 0;
};

TEST_F(NextPathTest, ItIsDrivenAlongWithoutAStandAtTheJunction) {
  TeachInto("robot", "hall");
  TeachInto("robot", "office");
  auto outcome = swarm_.Replay(device_, AlongHallThen("office"), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success);
  EXPECT_THAT(outcome->reason, HasSubstr("along the route, where it changed over"));
  ASSERT_NE(outcome->next, nullptr);
  const std::size_t changed_over = device_.told.size();
  EXPECT_GT(device_.told.back().linear_mps, 0.0);

  const auto on = GoOn(std::move(outcome->next));
  ASSERT_TRUE(on) << on.error().message;
  EXPECT_EQ(on->state, "ARRIVED") << on->reason;
  EXPECT_EQ(*on->summary.Find("route"), "office");
  for (std::size_t i = changed_over; i < changed_over + 20; ++i) {
    EXPECT_GT(device_.told[i].linear_mps, 0.0) << "frame " << i;
  }
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(NextPathTest, WhoeverDropsItHasTheRobotStand) {
  TeachInto("robot", "hall");
  TeachInto("robot", "office");
  auto outcome = swarm_.Replay(device_, AlongHallThen("office"), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  ASSERT_NE(outcome->next, nullptr);
  EXPECT_NE(device_.told.back(), motion::VelocityCommand{});
  outcome->next.reset();
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(NextPathTest, WhatItDoesNotHaveIsFetchedMeanwhile) {
  swarm_.StartServer();
  TeachInto("robot", "hall");
  TeachInto("scout", "office", true);
  const auto outcome = swarm_.Replay(device_, AlongHallThen("office"), true);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_NE(outcome->next, nullptr) << outcome->reason;
  const auto routes = swarm_.OpenStore("robot")->FindRoutesByName("office");
  ASSERT_TRUE(routes);
  ASSERT_EQ(routes->size(), 1U);
  EXPECT_EQ(routes->front().state, route::RouteState::kComplete);
}

TEST_F(NextPathTest, WithoutItTheRobotStandsAtTheJunction) {
  TeachInto("robot", "hall");
  waits_for_next_ = false;  // it will never be there
  const auto outcome = swarm_.Replay(device_, AlongHallThen("yard"), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kArrived);
  EXPECT_THAT(outcome->reason, HasSubstr("along the route, where it was to end"));
  EXPECT_EQ(outcome->next, nullptr);
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

TEST_F(NextPathTest, WhoDoesNotFindItStands) {
  TeachInto("robot", "hall");
  ElsewhereDevice elsewhere(kTaughtWalk);
  ScoutOptions options = swarm_.ScoutNamed("robot");
  options.route = "office";
  ASSERT_TRUE(swarm_.Teach(elsewhere, options, false));
  const auto outcome = swarm_.Replay(device_, AlongHallThen("office"), false);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->end, RunEnd::kArrived);
  EXPECT_EQ(outcome->next, nullptr);
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
}

// However slow it is to look.
TEST_F(NextPathTest, WhoLooksDrivesNoFurtherThanIsLeft) {
  NextPath next(device_, {}, KnownPath({}));
  const auto creeps = next.WhileItLooks({0.6, -0.3}, 0.05);
  EXPECT_DOUBLE_EQ(creeps.linear_mps, 0.1);
  EXPECT_DOUBLE_EQ(creeps.angular_radps, -0.05);
  const auto backs = next.WhileItLooks({-0.6, 0.3}, 0.05);
  EXPECT_DOUBLE_EQ(backs.linear_mps, -0.1);
  EXPECT_DOUBLE_EQ(backs.angular_radps, 0.05);
  const motion::VelocityCommand slow{0.08, 0.3};
  EXPECT_EQ(next.WhileItLooks(slow, 0.05), slow);
}

TEST_F(NextPathTest, AnotherRevisionThanTheOneThatItDrivesAlongIsToldOf) {
  route::RouteInfo route;
  route.name = "office";
  KnownPath path({});
  ASSERT_TRUE(path.Take(route));
  EXPECT_EQ(path.superseded(), "");
  ASSERT_TRUE(path.Take(route));
  EXPECT_EQ(path.superseded(), "");
  route.key.teaching = TeachingId(2);
  route.revision = RevisionNumber(2);
  ASSERT_TRUE(path.Take(route));
  EXPECT_THAT(path.superseded(), HasSubstr("robots follow revision 2 of 'office' now"));
}

}  // namespace
}  // namespace trailcast::agent
