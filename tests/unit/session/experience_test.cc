// These test what a follower notes for a refreshed route, on a walk towards a wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

constexpr int kWalkFrames = 60;
constexpr double kWalkStep_m = 0.02;

Observation SeenAt(int frame) {
  return {FromSeconds(frame / 20.0), test::WalkFrame(frame),
          motion::Pose2{kWalkStep_m * frame, 0.0, 0.0}};
}

const std::vector<route::Segment>& TaughtWalk() {
  static const std::vector<route::Segment> taught = [] {
    TeachOptions options;
    options.recorder.longest_m = 0.4;  // of the first one a follower is not sure from its beginning
    TeachSession session(options);
    std::vector<route::Segment> segments;
    const auto keep = [&](std::optional<route::Segment> segment) {
      if (segment) segments.push_back(std::move(*segment));
    };
    for (int i = 0; i < kWalkFrames; ++i) {
      auto step = session.Observe(SeenAt(i));
      EXPECT_TRUE(step);
      keep(std::move(step->finished));
    }
    keep(session.Finish());
    return segments;
  }();
  return taught;
}

struct Walked {
  ReplayState state = ReplayState::kWaiting;
  std::optional<refresh::Visit> visit;
};

Walked WalkAlong(const std::vector<route::Segment>& route, int frames, bool take_experience) {
  route::RouteInfo info;
  info.image_width_px = 160;
  info.image_height_px = 120;
  ReplayMethodOptions options;
  options.take_experience = take_experience;
  ReplaySession session(options, info);
  for (const route::Segment& segment : route) EXPECT_TRUE(session.AddSegment(segment));
  session.MarkComplete();
  Walked walked;
  for (int i = 0; i < frames; ++i) {
    const auto step = session.Observe(SeenAt(i));
    EXPECT_TRUE(step);
    walked.state = step->state;
  }
  walked.visit = session.TakeVisit();
  return walked;
}

TEST(Experience, OnlyWhoArrivedAndWasToNoteItTellsWhatItMet) {
  EXPECT_FALSE(WalkAlong(TaughtWalk(), kWalkFrames, false).visit);
  EXPECT_FALSE(WalkAlong(TaughtWalk(), kWalkFrames / 2, true).visit);
  const Walked walked = WalkAlong(TaughtWalk(), kWalkFrames + 5, true);
  ASSERT_EQ(walked.state, ReplayState::kArrived);
  EXPECT_TRUE(walked.visit);
}

TEST(Experience, WhereNothingHasChangedNextToNothingIsMissed) {
  const Walked walked = WalkAlong(TaughtWalk(), kWalkFrames + 5, true);
  ASSERT_TRUE(walked.visit);
  ASSERT_FALSE(walked.visit->segments.empty());
  int found = 0;
  int missed = 0;
  for (const refresh::SegmentVisit& each : walked.visit->segments) {
    if (each.features.empty()) continue;  // only what is recognised of it was looked at
    ASSERT_EQ(each.features.size(), TaughtWalk()[each.index.value()].features.size());
    found += static_cast<int>(
        std::count(each.features.begin(), each.features.end(), refresh::Sought::kFound));
    missed += static_cast<int>(
        std::count(each.features.begin(), each.features.end(), refresh::Sought::kMissed));
  }
  EXPECT_GE(found, 20);
  EXPECT_LE(missed, found / 10);
}

// A third of what the scout taught is left out: the follower comes upon some of it, and tells it as
// the scout did.
TEST(Experience, WhatTheScoutSawAndTheRouteLacksIsOfferedAsTheScoutSawIt) {
  std::vector<route::Segment> route = TaughtWalk();
  std::vector<std::vector<route::Feature>> left_out(route.size());
  for (std::size_t i = 0; i < route.size(); ++i) {
    std::vector<route::Feature> kept;
    for (std::size_t k = 0; k < route[i].features.size(); ++k) {
      (k % 3 == 0 ? left_out[i] : kept).push_back(route[i].features[k]);
    }
    route[i].features = kept;
  }
  const Walked walked = WalkAlong(route, kWalkFrames + 5, true);
  ASSERT_TRUE(walked.visit);
  int offered = 0;
  int same = 0;
  for (const refresh::SegmentVisit& each : walked.visit->segments) {
    for (const route::Feature& feature : each.offered) {
      ++offered;
      for (const route::Feature& taught : left_out[each.index.value()]) {
        const auto apart_px = [](const route::TrackKnot& a, const route::TrackKnot& b) {
          return std::hypot(a.u_px - b.u_px, a.v_px - b.v_px);
        };
        if (apart_px(feature.first(), taught.first()) > 1.5) continue;
        ++same;
        EXPECT_LT(apart_px(feature.milestone(), taught.milestone()), 2.0);
        EXPECT_EQ(feature.track.size(), taught.track.size());
      }
    }
  }
  EXPECT_GE(offered, 5);
  EXPECT_GE(same, 3);
}

}  // namespace
}  // namespace trailcast::agent
