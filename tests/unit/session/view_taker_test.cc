// How places look to a follower without odometry that sees half of them changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "agent/session/replay_session.h"
#include "agent/session/teach_session.h"
#include "services/refresh/refresh.h"
#include "services/view/view_table.h"
#include "services/vision/view_features.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

constexpr int kLapFrames = 60;
constexpr int kLapWidth_px = 160;
constexpr int kSpare_px = 20;  // to either side, for robots that look elsewhere

enum class Wall { kAsTaught, kHalfChanged, kOther };

// Where dirt is on the lens, if there is any: to the right and below.
struct Dirt {
  static constexpr int kFrom_px = 6;
  static constexpr int kTo_px = 56;
  static bool Covers(int x, int y) {
    return x >= kLapWidth_px - kTo_px && x < kLapWidth_px - kFrom_px && y >= 120 - kTo_px &&
           y < 120 - kFrom_px;
  }
  static std::uint8_t Grey(int x, int y) {
    return static_cast<std::uint8_t>(((x / 7) * 31 + (y / 5) * 57 + (x / 7) * (y / 5) * 13) % 256);
  }
};

// Returns a picture of a walk of some ten key views, seen by a robot that looks so many pixels to
// the right of where the scout did.
image::GrayImage LapFrame(int number, Wall wall, int right_px = 0) {
  const image::GrayImage taught = test::WalkFrame(2 * number, kLapWidth_px + 2 * kSpare_px);
  image::GrayImage picture{kLapWidth_px, taught.height, {}};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < kLapWidth_px; ++x) {
      const int at = x + kSpare_px + right_px;
      const bool other =
          wall == Wall::kOther || (wall == Wall::kHalfChanged && at > taught.width / 2);
      const auto there = static_cast<std::size_t>(y * taught.width + at);
      const std::size_t opposite = taught.pixels.size() - 1 - there;
      picture.pixels.push_back(other ? static_cast<std::uint8_t>(255 - taught.pixels[opposite])
                                     : taught.pixels[there]);
    }
  }
  return picture;
}

Observation SeenOnLap(int number, Wall wall, int right_px = 0) {
  return {FromSeconds(number / 20.0), LapFrame(number, wall, right_px), std::nullopt};
}

const std::vector<route::Segment>& TaughtLap() {
  static const std::vector<route::Segment> taught = [] {
    TeachSession session;
    std::vector<route::Segment> segments;
    for (int i = 0; i < kLapFrames; ++i) {
      auto step = session.Observe(SeenOnLap(i, Wall::kAsTaught));
      EXPECT_TRUE(step);
      if (step->finished) segments.push_back(std::move(*step->finished));
    }
    if (auto last = session.Finish()) segments.push_back(std::move(*last));
    return segments;
  }();
  return taught;
}

Observation WithDirt(Observation seen) {
  for (int y = 0; y < seen.image.height; ++y) {
    for (int x = 0; x < seen.image.width; ++x) {
      if (Dirt::Covers(x, y)) {
        seen.image.pixels[static_cast<std::size_t>(y * seen.image.width + x)] = Dirt::Grey(x, y);
      }
    }
  }
  return seen;
}

struct Lap {
  ReplayStep last;
  std::optional<refresh::Visit> visit;
};

Lap DriveLap(const std::vector<route::Segment>& route, Wall wall, int right_px = 0,
             bool dirt = false) {
  route::RouteInfo info;
  info.image_width_px = kLapWidth_px;
  info.image_height_px = 120;
  ReplayMethodOptions options;
  options.take_experience = true;
  ReplaySession session(options, info);
  for (const route::Segment& segment : route) EXPECT_TRUE(session.AddSegment(segment));
  session.MarkComplete();
  Lap walked;
  for (int i = 0; i < kLapFrames + 5; ++i) {
    Observation seen = SeenOnLap(std::min(i, kLapFrames - 1), wall, right_px);
    seen.stamp = FromSeconds(i / 20.0);
    const auto step = session.Observe(dirt ? WithDirt(std::move(seen)) : std::move(seen));
    EXPECT_TRUE(step);
    walked.last = *step;
  }
  walked.visit = session.TakeVisit();
  return walked;
}

int CountOf(const refresh::Visit& visit, refresh::Sought sought) {
  int count = 0;
  for (const refresh::SegmentVisit& each : visit.segments) {
    count += static_cast<int>(std::count(each.views.begin(), each.views.end(), sought));
  }
  return count;
}

std::size_t OfferedBy(const refresh::Visit& visit) {
  std::size_t offered = 0;
  for (const refresh::SegmentVisit& each : visit.segments) offered += each.offered_views.size();
  return offered;
}

TEST(ViewTaker, WhereNothingHasChangedAllIsRecognisedAndNothingOffered) {
  const Lap walked = DriveLap(TaughtLap(), Wall::kAsTaught);
  ASSERT_TRUE(walked.visit) << walked.last.reason;
  EXPECT_GE(CountOf(*walked.visit, refresh::Sought::kFound), 2);
  EXPECT_EQ(CountOf(*walked.visit, refresh::Sought::kMissed), 0);
  EXPECT_EQ(OfferedBy(*walked.visit), 0U);
}

// Whatever way the robot looked, it lies where the scout would have seen it.
TEST(ViewTaker, WhatHasChangedIsOfferedAsTheScoutWouldSeeIt) {
  for (const int right_px : {0, 8}) {
    const Lap walked = DriveLap(TaughtLap(), Wall::kHalfChanged, right_px);
    ASSERT_TRUE(walked.visit) << walked.last.reason;
    ASSERT_GE(OfferedBy(*walked.visit), 1U);
    double begins_s = 0.0;
    for (const refresh::SegmentVisit& each : walked.visit->segments) {
      const route::Segment& segment = TaughtLap()[each.index.value()];
      for (const refresh::OfferedView& offered : each.offered_views) {
        const double at_s = begins_s + segment.key_views[offered.beside].s * segment.duration_s;
        vision::ViewDescriber describer;
        const auto then = view::Tabulate(
            describer.Describe(LapFrame(static_cast<int>(20.0 * at_s + 0.5), Wall::kHalfChanged)),
            kLapWidth_px);
        const view::Comparison same =
            view::Compare(view::Tabulate(offered.features, kLapWidth_px), then);
        EXPECT_GE(same.agreed(), 20) << "at " << at_s << " s";
        EXPECT_NEAR(same.scale, 1.0, 0.03);
        EXPECT_NEAR(same.shift_u, 0.0, 0.02);
        EXPECT_NEAR(same.shift_v, 0.0, 0.02);
      }
      begins_s += segment.duration_s;
    }
  }
}

TEST(ViewTaker, ARefreshedRouteIsRecognisedByMoreAndHasNothingToLearnOfTheSame) {
  const Lap first = DriveLap(TaughtLap(), Wall::kHalfChanged);
  ASSERT_TRUE(first.visit);
  const auto refreshed = refresh::Refresh(TaughtLap(), *first.visit);
  ASSERT_TRUE(refreshed) << refreshed.error().message;
  ASSERT_GE(refreshed->views.added, 1);
  const Lap second = DriveLap(refreshed->segments, Wall::kHalfChanged);
  ASSERT_TRUE(second.visit) << second.last.reason;
  EXPECT_EQ(OfferedBy(*second.visit), 0U);
  EXPECT_GT(second.last.decision.agreeing, first.last.decision.agreeing);
  const Lap as_before = DriveLap(refreshed->segments, Wall::kAsTaught);
  EXPECT_EQ(as_before.last.state, ReplayState::kArrived);
}

// It would be recognised wherever a robot with the same dirt is.
TEST(ViewTaker, DirtOnTheLensIsNoPartOfAPlace) {
  const Lap lap = DriveLap(TaughtLap(), Wall::kHalfChanged, 0, true);
  ASSERT_TRUE(lap.visit) << lap.last.reason;
  ASSERT_GE(OfferedBy(*lap.visit), 1U);
  std::ptrdiff_t dirty = 0;
  std::size_t all = 0;
  for (const refresh::SegmentVisit& each : lap.visit->segments) {
    for (const refresh::OfferedView& offered : each.offered_views) {
      all += offered.features.size();
      dirty += std::count_if(
          offered.features.begin(), offered.features.end(), [](const route::ViewFeature& feature) {
            return Dirt::Covers(static_cast<int>(feature.u_px) + kLapWidth_px / 2,
                                static_cast<int>(feature.v_px) + 60);
          });
    }
  }
  EXPECT_LE(20 * dirty, static_cast<std::ptrdiff_t>(all)) << dirty << " of " << all;
}

TEST(ViewTaker, WhoSeesAnotherPlaceTellsNothing) {
  EXPECT_FALSE(DriveLap(TaughtLap(), Wall::kOther).visit);
}

}  // namespace
}  // namespace trailcast::agent
