// A scout that starts again on a store with a teaching that was cut off.
#include "agent/teach/unfinished.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/teach/teachings.h"
#include "services/route/digest.h"
#include "tests/unit/agent/swarm.h"

namespace trailcast::agent {
namespace {

using route::RouteState;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr int kFrames = 150;
constexpr int kFailsAt = 110;

class UnfinishedTest : public testing::Test {
 protected:
  // Teaches until the camera fails on the way.
  void TeachAndFail() {
    test::WalkDevice device(kFrames);
    device.before_frame = [](int frame) -> Result<void> {
      if (frame < kFailsAt) return {};
      return Fail(ErrorCode::kUnavailable, "the camera is unplugged");
    };
    ASSERT_FALSE(swarm_.Teach(device, Scout(), false));
    ASSERT_TRUE(All().at(0).cut_off);
  }
  // Leaves what a killed scout leaves: all that it taught but the last segment.
  void TeachAndDie() {
    test::WalkDevice device(kFailsAt);
    ASSERT_TRUE(swarm_.Teach(device, swarm_.ScoutNamed("whole"), false));
    const auto whole = swarm_.OpenStore("whole");
    route::RouteInfo info = whole->FindRoutesByName("hall").value().at(0);
    std::vector<route::SegmentPiece> pieces;
    info.length_m = 0.0;
    info.bytes = 0;
    for (std::uint32_t i = 0; i + 1 < info.segment_count; ++i) {
      pieces.push_back(whole->ReadSegment(info.key, SegmentIndex(i)).value());
      info.length_m += route::Open(pieces.back())->length_m;
      info.bytes += pieces.back().bytes.size();
    }
    info.segment_count -= 1;
    info.scout = AgentId("scout");
    info.state = RouteState::kTeaching;
    const auto store = swarm_.OpenStore("scout");
    ASSERT_TRUE(store->AppendSegments(pieces));
    ASSERT_TRUE(store->PutRoute(info));
  }
  ScoutOptions Scout(Unfinished unfinished = Unfinished::kKeep) const {
    ScoutOptions options = swarm_.ScoutNamed("scout");
    options.unfinished = unfinished;
    return options;
  }
  // Newest first.
  std::vector<route::RouteInfo> All(const std::string& agent = "scout") {
    return swarm_.OpenStore(agent)->FindRoutesByName("hall").value();
  }
  Result<ReplayOutcome> Follow() {
    std::filesystem::copy_file(swarm_.StoreFile("scout"), swarm_.StoreFile("robot"));
    test::WalkDevice device(kFrames + 20);
    return swarm_.Replay(device, swarm_.FollowerNamed("robot"), false);
  }

  test::Swarm swarm_;
  test::WalkDevice device_{kFrames};
};

TEST_F(UnfinishedTest, WhatAKillCutOffIsTheSameTeachingWhenItGoesOn) {
  TeachAndDie();
  const route::RouteInfo cut_off = All().at(0);
  ASSERT_GE(cut_off.segment_count, 1U);
  const auto taught = swarm_.Teach(device_, Scout(Unfinished::kGoOn), false);
  ASSERT_TRUE(taught) << taught.error().message;
  const auto all = All();
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].key, cut_off.key);
  EXPECT_EQ(all[0].state, RouteState::kComplete);
  EXPECT_FALSE(all[0].cut_off);
  EXPECT_GT(all[0].segment_count, cut_off.segment_count);
  EXPECT_NEAR(all[0].length_m, 0.02 * (kFrames - 1), 0.2) << "no way twice, and none left out";
  const auto outcome = Follow();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->state << ": " << outcome->reason;
}

TEST_F(UnfinishedTest, WhatAFailureEndedGoesOnAsTheNextRevisionWithTheSameSegmentsFirst) {
  TeachAndFail();
  const route::RouteInfo cut_off = All().at(0);
  const auto taught = swarm_.Teach(device_, Scout(Unfinished::kGoOn), false);
  ASSERT_TRUE(taught) << taught.error().message;
  const auto all = All();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[1], cut_off);
  EXPECT_EQ(all[0].revision, RevisionNumber(2));
  EXPECT_FALSE(all[0].cut_off);
  EXPECT_NEAR(all[0].length_m, 0.02 * (kFrames - 1), 0.2);
  {
    const auto store = swarm_.OpenStore("scout");
    for (std::uint32_t i = 0; i < cut_off.segment_count; ++i) {
      EXPECT_EQ(store->ReadSegment(all[0].key, SegmentIndex(i))->digest,
                store->ReadSegment(cut_off.key, SegmentIndex(i))->digest);
    }
  }
  const auto outcome = Follow();
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_TRUE(outcome->success) << outcome->state << ": " << outcome->reason;
}

TEST_F(UnfinishedTest, WhatGoesOnAtAServerIsFollowed) {
  TeachAndDie();
  swarm_.StartServer();
  const auto taught = swarm_.Teach(device_, Scout(Unfinished::kGoOn), true);
  ASSERT_TRUE(taught) << taught.error().message;
  swarm_.StopServer();
  const auto there = All("server");
  ASSERT_THAT(there, SizeIs(1));
  EXPECT_EQ(there[0].standing, route::Standing::kActive);
  EXPECT_EQ(there[0].segment_count, All().at(0).segment_count);
}

TEST_F(UnfinishedTest, GoesOnNowhereButWhereItEnded) {
  TeachAndDie();
  const route::RouteInfo cut_off = All().at(0);
  device_.next = kFrames - 10;  // the robot stands beyond it
  const auto taught = swarm_.Teach(device_, Scout(Unfinished::kGoOn), false);
  ASSERT_FALSE(taught);
  EXPECT_THAT(taught.error().message, AllOf(HasSubstr("did not come by where route 'hall'"),
                                            HasSubstr("it stays as it was")));
  EXPECT_THAT(All(), ElementsAre(cut_off));
}

TEST_F(UnfinishedTest, GoesOnWithTheSameCameraOnly) {
  class Other : public test::WalkDevice {
   public:
    using WalkDevice::WalkDevice;
    std::string camera() const override { return "wide 160x120"; }
  } other(kFrames);
  TeachAndDie();
  const auto taught = swarm_.Teach(other, Scout(Unfinished::kGoOn), false);
  ASSERT_FALSE(taught);
  EXPECT_THAT(taught.error().message, HasSubstr("was taught with camera 'walk 160x120'"));
}

TEST_F(UnfinishedTest, SaysSoWhereThereIsNothingToGoOnWith) {
  const auto none = swarm_.Teach(device_, Scout(Unfinished::kGoOn), false);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("there is nothing to go on with"));
  ASSERT_TRUE(swarm_.Teach(device_, Scout(), false));
  test::WalkDevice again(kFrames);
  EXPECT_FALSE(swarm_.Teach(again, Scout(Unfinished::kGoOn), false)) << "it was taught to its end";
}

TEST_F(UnfinishedTest, IsKeptUnlessAskedForAndTaughtAnew) {
  TeachAndDie();
  const route::RouteInfo cut_off = All().at(0);
  ASSERT_TRUE(swarm_.Teach(device_, Scout(Unfinished::kAsk), false)) << "nobody is at a terminal";
  const auto all = All();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_EQ(all[1], cut_off);
  EXPECT_FALSE(all[0].cut_off);
}

TEST_F(UnfinishedTest, IsRetiredWhenItIsDiscardedAndTheRouteIsTaughtAnew) {
  TeachAndDie();
  const auto taught = swarm_.Teach(device_, Scout(Unfinished::kDiscard), false);
  ASSERT_TRUE(taught) << taught.error().message;
  const auto all = All();
  ASSERT_THAT(all, SizeIs(2));
  EXPECT_FALSE(all[0].cut_off);
  EXPECT_EQ(all[0].state, RouteState::kComplete);
  EXPECT_EQ(all[1].standing, route::Standing::kRetired);
  EXPECT_EQ(exchange::ChooseRoute(all), all[0]);
}

TEST_F(UnfinishedTest, TeachingsShowsWhatIsInAStoreAndWhatMayBecomeOfIt) {
  EXPECT_THAT(*TeachingsText(*swarm_.OpenStore("empty"), "empty.db"),
              HasSubstr("no teaching in empty.db"));
  TeachAndDie();
  const std::string id = All().at(0).key.route.value().substr(0, 7);
  EXPECT_THAT(*TeachingsText(*swarm_.OpenStore("scout"), "scout.db"),
              AllOf(HasSubstr("hall"), HasSubstr(id + "@1"), HasSubstr("unfinished"),
                    HasSubstr("--unfinished go-on|keep|discard")));
  ASSERT_TRUE(swarm_.Teach(device_, Scout(Unfinished::kGoOn), false));
  EXPECT_THAT(*TeachingsText(*swarm_.OpenStore("scout"), "scout.db"),
              AllOf(HasSubstr(id + "@1"), Not(HasSubstr("unfinished"))));
}

}  // namespace
}  // namespace trailcast::agent
