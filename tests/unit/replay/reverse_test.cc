#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "services/replay/lane_keeping.h"
#include "services/replay/path_follower.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

// Its landmarks are ahead of all that is driven below.
const test::LandmarkScene kReverseScene = test::LandmarkScene::Corridor(5.0, 16.0, 120, 39);
constexpr double kReverseFrame_s = 1.0 / 30.0;

// A robot beside a circle of curvature `curvature_per_m`, steered along it by what it knows
// exactly.
PathOffset Steer(PathOffset offset, double curvature_per_m, double speed_mps, double length_m) {
  const int steps = static_cast<int>(length_m / (std::abs(speed_mps) * kReverseFrame_s));
  for (int i = 0; i < steps; ++i) {
    const double turn = LaneKeepingTurnRate(offset, curvature_per_m, speed_mps);
    const double along_mps =
        speed_mps * std::cos(offset.heading_rad) / (1.0 - curvature_per_m * offset.left_m);
    offset.left_m += kReverseFrame_s * speed_mps * std::sin(offset.heading_rad);
    offset.heading_rad += kReverseFrame_s * (turn - curvature_per_m * along_mps);
    offset.along_m += kReverseFrame_s * along_mps;
  }
  return offset;
}

TEST(LaneKeeping, MeetsThePathForwardsAndBackwards) {
  for (const double speed_mps : {0.3, -0.3}) {
    for (const double curvature_per_m : {0.0, 0.5, -0.5}) {
      for (const auto& [left_m, heading_rad] : {std::pair(0.3, 0.0), std::pair(-0.2, 0.4)}) {
        const PathOffset end = Steer({left_m, heading_rad}, curvature_per_m, speed_mps, 4.0);
        EXPECT_NEAR(end.left_m, 0.0, 0.01) << speed_mps << " " << curvature_per_m;
        EXPECT_NEAR(end.heading_rad, 0.0, 0.02) << speed_mps << " " << curvature_per_m;
        EXPECT_GT(end.along_m * speed_mps, 0.0);
      }
    }
  }
}

struct TaughtShunt {
  std::vector<test::TaughtRun> runs;  // a segment each
  std::vector<motion::Pose2> driven;
};

// The landmarks of a segment's features, told by where they were seen at its beginning: those in
// view when it is finished may be fewer, as the robot has gone on the other way by then.
std::vector<int> Landmarks(const route::Segment& segment,
                           const std::vector<route::TrackedFeature>& at_begin) {
  std::vector<int> landmarks;
  for (const route::Feature& feature : segment.features) {
    const route::TrackKnot& first = feature.track.front();
    for (const route::TrackedFeature& seen : at_begin) {
      if (static_cast<float>(seen.u_px) == first.u_px &&
          static_cast<float>(seen.v_px) == first.v_px)
        landmarks.push_back(seen.id);
    }
  }
  return landmarks;
}

// Drives the arcs, those of a negative length backwards, and teaches what it sees.
TaughtShunt Teach(const motion::Pose2& start, const std::vector<test::Arc>& arcs) {
  constexpr double kStep_m = 0.01;
  TaughtShunt shunt;
  teach::SegmentRecorder recorder(320);
  motion::Pose2 pose = start;
  int frame = 0;
  std::vector<route::TrackedFeature> at_begin;
  std::vector<route::TrackedFeature> in_view;
  const auto begin = [&] {
    at_begin = in_view = kReverseScene.Look(pose);
    recorder.Begin(FromSeconds(frame * kReverseFrame_s), test::Describe(in_view), pose);
  };
  const auto finish = [&] {
    auto segment = recorder.Finish();
    if (!segment) return;
    test::TaughtRun& run = shunt.runs.emplace_back();
    run.segment = std::move(*segment);
    run.landmark_of_feature = Landmarks(run.segment, at_begin);
    run.end = pose;
  };
  begin();
  for (const test::Arc& arc : arcs) {
    const int steps = static_cast<int>(std::lround(std::abs(arc.length_m) / kStep_m));
    for (int i = 0; i < steps; ++i) {
      pose = motion::Advance(pose, {std::copysign(kStep_m, arc.length_m), arc.turn_rad / steps});
      shunt.driven.push_back(pose);
      std::vector<route::TrackedFeature> still;
      for (const auto& now : kReverseScene.Look(pose)) {
        const bool before = std::any_of(in_view.begin(), in_view.end(),
                                        [&](const auto& each) { return each.id == now.id; });
        if (before) still.push_back(now);
      }
      in_view = std::move(still);
      ++frame;
      if (recorder.Add(FromSeconds(frame * kReverseFrame_s), in_view, pose) !=
          teach::SegmentRecorder::Event::kGoesOn) {
        finish();
        begin();
      }
    }
  }
  finish();
  return shunt;
}

double Off(const std::vector<motion::Pose2>& path, const motion::Pose2& pose) {
  double least_m = 1e9;
  for (const motion::Pose2& at : path) {
    least_m = std::min(least_m, (motion::Position(at) - motion::Position(pose)).norm());
  }
  return least_m;
}

struct Followed {
  motion::Pose2 end;
  double worst_m = 0.0;  // off what was taught, after the first metre
  double least_m = 9.0;  // how far back it came, along x
  int segments = 0;
};

Followed Follow(const TaughtShunt& shunt, motion::Pose2 pose) {
  PathFollower follower(320, 1.0);
  for (const test::TaughtRun& run : shunt.runs) follower.Learn(run.segment);
  Followed followed;
  std::size_t at = 0;
  follower.Begin(shunt.runs[at].segment);
  motion::OdometryIncrement moved;
  double driven_m = 0.0;
  for (int frame = 0; frame < 3000 && at < shunt.runs.size(); ++frame) {
    const FollowStep step =
        follower.Step({test::Matched(kReverseScene, shunt.runs[at], pose), moved});
    EXPECT_LE(step.command.linear_mps * (shunt.runs[at].segment.reverse ? 1.0 : -1.0), 0.0);
    moved = {step.command.linear_mps * kReverseFrame_s,
             step.command.angular_radps * kReverseFrame_s};
    pose = motion::Advance(pose, moved);
    driven_m += std::abs(moved.distance_m);
    if (driven_m > 1.0) followed.worst_m = std::max(followed.worst_m, Off(shunt.driven, pose));
    followed.least_m = std::min(followed.least_m, pose.x_m);
    if (!step.ended) continue;
    EXPECT_EQ(step.fraction, 1.0);
    if (++at < shunt.runs.size()) follower.Begin(shunt.runs[at].segment);
  }
  followed.segments = static_cast<int>(at);
  followed.end = pose;
  return followed;
}

TEST(PathFollower, GoesBackAndForthAsItWasTaught) {
  const TaughtShunt shunt = Teach({2.0, 0.0, 0.0}, {{1.0, 0.0}, {-2.6, 0.5}, {2.0, -0.4}});
  ASSERT_GE(shunt.runs.size(), 4U);
  EXPECT_FALSE(shunt.runs.front().segment.reverse);
  EXPECT_TRUE(shunt.runs[1].segment.reverse);
  EXPECT_FALSE(shunt.runs.back().segment.reverse);
  for (const double left_m : {0.0, 0.08, -0.08}) {
    const Followed followed = Follow(shunt, {2.0, left_m, 0.03});
    EXPECT_EQ(followed.segments, static_cast<int>(shunt.runs.size()));
    EXPECT_LT(followed.worst_m, 0.05) << left_m;
    EXPECT_LT(followed.least_m, 0.62) << left_m;
    EXPECT_LT(Off({shunt.driven.back()}, followed.end), 0.06) << left_m;
    EXPECT_NEAR(followed.end.heading_rad, shunt.driven.back().heading_rad, 0.05) << left_m;
  }
}

TEST(PathFollower, BeginsARouteBackwards) {
  const TaughtShunt shunt = Teach({3.0, 0.0, 0.0}, {{-3.0, 0.6}});
  ASSERT_GE(shunt.runs.size(), 2U);
  for (const test::TaughtRun& run : shunt.runs) EXPECT_TRUE(run.segment.reverse);
  const Followed followed = Follow(shunt, {3.0, 0.06, -0.03});
  EXPECT_EQ(followed.segments, static_cast<int>(shunt.runs.size()));
  EXPECT_LT(followed.worst_m, 0.06);
  EXPECT_LT(Off({shunt.driven.back()}, followed.end), 0.06);
}

TEST(PathFollower, FindsItselfOnTheWayBack) {
  const TaughtShunt shunt = Teach({3.0, 0.0, 0.0}, {{-1.9, 0.2}});
  ASSERT_EQ(shunt.runs.size(), 1U);
  const test::TaughtRun& run = shunt.runs.front();
  const motion::Pose2& there = shunt.driven[120];
  PathFollower follower(320, 1.0);
  follower.BeginAt(run.segment, 0.55);
  FollowStep step;
  for (int i = 0; i < 20; ++i) {
    step = follower.Step({test::Matched(kReverseScene, run, there), motion::OdometryIncrement{}});
  }
  EXPECT_NEAR(step.fraction, (1.2 - (1.9 - run.segment.length_m)) / run.segment.length_m, 0.03);
  EXPECT_NEAR(step.offset->along_m, step.fraction * run.segment.length_m, 1e-6);
  EXPECT_NEAR(step.offset->left_m, 0.0, 0.03);
  const auto milestone = follower.ExpectAtMilestone();
  for (const auto& seen : test::Matched(kReverseScene, run, run.end)) {
    const auto& expected = milestone[static_cast<std::size_t>(seen.id)];
    EXPECT_NEAR(expected.u_px, seen.u_px, 6.0);
    EXPECT_NEAR(expected.v_px, seen.v_px, 6.0);
  }
}

}  // namespace
}  // namespace trailcast::replay
