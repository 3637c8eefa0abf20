#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "services/base/time.h"
#include "services/motion/motion.h"
#include "services/route/tracked_feature.h"
#include "services/teach/heading_fit.h"

namespace trailcast::teach {

struct SegmentRecorderOptions {
  // A segment ends when fewer than this share of its first features survive (III).
  double survival_share = 0.5;
  // ... or at this length. Where all features are far away half of them survive for long, and the
  // few that come near on the way would never be stored. The paper has no such limit.
  double longest_m = 2.0;
  // Where segments are short (turns, clutter close by) their features overlap in what they say: of
  // a segment's survivors only so many a metre are kept, the strongest, but never fewer than the
  // second figure. Holds a route under 5 kB a metre, one of sharp turns only just.
  double features_per_metre = 40.0;
  std::size_t fewest_kept = 11;
  // Knots kept of each feature's track, first and last included; the paper needs those two. No
  // closer together than the second figure, but three at least.
  int knots = 4;
  double knot_spacing_m = 0.15;
};

// Turns the tracked features of one segment after the other into what the route stores of it.
// Begin a segment, add frames until Add says it ends, take it with Finish, begin the next with the
// same frame.
class SegmentRecorder {
 public:
  explicit SegmentRecorder(const SegmentRecorderOptions& options = {}) : options_(options) {}

  // The segment's first image: its features, the strongest first, and the odometry pose at that
  // moment, if any.
  void Begin(SensorTime stamp, std::vector<route::DescribedFeature> features,
             const std::optional<motion::Pose2>& odometry);

  // The next image: which of the features are still there. True: the segment ends with this image.
  [[nodiscard]] bool Add(SensorTime stamp, const std::vector<route::TrackedFeature>& tracked,
                         const std::optional<motion::Pose2>& odometry);

  // The segment from Begin to the last Add, with the features that were tracked throughout. Nothing
  // if no image was added since Begin, or if it holds neither a feature nor a step of odometry.
  [[nodiscard]] std::optional<route::Segment> Finish();

  [[nodiscard]] double distance_m() const { return headings_.back().distance_m; }

 private:
  // One image of the segment.
  struct Moment {
    SensorTime stamp{0};
    double distance_m = 0.0;
    std::unordered_map<int, route::TrackedFeature> features;
  };

  [[nodiscard]] std::size_t MostFeatures(const route::Segment& segment) const;
  [[nodiscard]] int KnotsFor(double length_m) const;
  [[nodiscard]] route::Feature Store(const route::DescribedFeature& feature, int knots) const;
  [[nodiscard]] double FractionAt(const Moment& moment) const;

  SegmentRecorderOptions options_;
  SegmentIndex next_index_{0};
  std::vector<route::DescribedFeature> first_;
  std::vector<Moment> moments_;
  std::vector<HeadingSample> headings_{{}};
  SensorTime moving_{0};  // time driven; a robot that waits does not teach slowness
  std::optional<motion::Pose2> last_odometry_;
};

}  // namespace trailcast::teach
