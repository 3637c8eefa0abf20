#pragma once

#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "services/route/tracked_feature.h"
#include "services/teach/segment_recorder.h"
#include "tests/support/landmark_scene.h"

namespace trailcast::test {

inline std::vector<route::DescribedFeature> Describe(
    const std::vector<route::TrackedFeature>& features) {
  std::vector<route::DescribedFeature> described;
  described.reserve(features.size());
  for (const auto& feature : features) described.push_back({feature, {}});
  return described;
}

// A segment is taught by driving such arcs from `start` on, 30 steps a second at 0.3 m/s. Its
// features are those in view all the way, in the order of the landmarks' numbers.
struct Arc {
  double length_m = 0.0;
  double turn_rad = 0.0;  // left positive
};

// These are how the scout's camera is mounted, its lens, and how the ground tilts it along the
// path.
struct ScoutEye {
  double yaw_rad = 0.0;  // to the left
  double focal_px = LandmarkScene::kFocal_px;
  std::function<Tilt(const motion::Pose2&)> tilt = [](const motion::Pose2&) { return Tilt{}; };
};

struct TaughtRun {
  route::Segment segment;
  std::vector<int> landmark_of_feature;
  motion::Pose2 end;
};

inline TaughtRun TeachArcs(const LandmarkScene& scene, const motion::Pose2& start,
                           const std::vector<Arc>& arcs, const ScoutEye& eye = {}) {
  constexpr double kStep_m = 0.01;
  teach::SegmentRecorder recorder(320);
  motion::Pose2 pose = start;
  const auto look = [&] {
    return scene.Look(motion::Compose(pose, {0.0, 0.0, eye.yaw_rad}), eye.tilt(pose), eye.focal_px);
  };
  std::vector<route::TrackedFeature> in_view = look();
  recorder.Begin(SensorTime{0}, Describe(in_view), pose);
  int frame = 0;
  for (const Arc& arc : arcs) {
    const int steps = static_cast<int>(std::lround(arc.length_m / kStep_m));
    for (int i = 0; i < steps; ++i) {
      pose = motion::Advance(pose, {kStep_m, arc.turn_rad / steps});
      std::vector<route::TrackedFeature> still;
      for (const auto& now : look()) {
        for (const auto& before : in_view) {
          if (before.id == now.id) still.push_back(now);
        }
      }
      in_view = still;
      std::ignore = recorder.Add(FromSeconds(++frame / 30.0), in_view, pose);
    }
  }
  TaughtRun run{*recorder.Finish(), {}, pose};
  for (const auto& feature : in_view) run.landmark_of_feature.push_back(feature.id);
  run.landmark_of_feature.resize(run.segment.features.size());  // the first ones are kept
  return run;
}

// Returns what a robot at `pose` sees of the run's features, numbered as in the segment.
inline std::vector<route::TrackedFeature> Matched(const LandmarkScene& scene, const TaughtRun& run,
                                                  const motion::Pose2& pose, const Tilt& tilt = {},
                                                  double focal_px = LandmarkScene::kFocal_px) {
  std::vector<route::TrackedFeature> matched;
  for (const auto& now : scene.Look(pose, tilt, focal_px)) {
    for (std::size_t i = 0; i < run.landmark_of_feature.size(); ++i) {
      if (run.landmark_of_feature[i] == now.id) {
        matched.push_back({static_cast<int>(i), now.u_px, now.v_px});
      }
    }
  }
  return matched;
}

}  // namespace trailcast::test
