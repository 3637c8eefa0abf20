#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "agent/replay_session.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_finder.h"

namespace trailcast::agent {

// Where a segment's stored features are in the follower's picture, whatever its camera: finds them
// at each segment's start and learns how the two cameras' magnifications compare.
class HandOver {
 public:
  HandOver(ReplayMethod method, int scout_width_px, int width_px);

  // The segment's features as found in the frame that begins it, in the follower's own pixels.
  [[nodiscard]] std::vector<route::TrackedFeature> ToSegment(const image::GrayImage& frame,
                                                             const route::Segment& segment);

  // The same features once more, at fraction `s` of the segment, when tracking has lost many.
  [[nodiscard]] std::vector<route::TrackedFeature> Again(const image::GrayImage& frame,
                                                         const route::Segment& segment,
                                                         double s) const;

  struct Recovered {
    std::size_t segment = 0;  // position in `ahead`
    std::vector<route::TrackedFeature> features;
  };
  // Anywhere in the segments `ahead`, for a robot that lost its features.
  [[nodiscard]] std::optional<Recovered> Recover(const image::GrayImage& frame,
                                                 std::span<const route::Segment> ahead) const;

  // The follower's pixels at the scout's magnification.
  [[nodiscard]] std::vector<route::TrackedFeature> InScoutPixels(
      std::vector<route::TrackedFeature> features) const;

  [[nodiscard]] double magnification() const { return magnification_; }
  // Share of stored features found, mean over the hand-overs so far.
  [[nodiscard]] double found_share() const { return count_ > 0 ? share_sum_ / count_ : 0.0; }
  [[nodiscard]] int count() const { return count_; }

 private:
  [[nodiscard]] vision::FindResult Find(const image::GrayImage& frame,
                                        std::span<const route::Feature> sought, double s,
                                        bool wide) const;
  void Learn(const vision::ViewFit& fit, std::size_t features);

  vision::FeatureFinder finder_;
  bool any_camera_;
  double magnification_;  // follower's pixels per scout's pixel
  std::deque<double> seen_magnifications_;
  double share_sum_ = 0.0;
  int count_ = 0;
};

}  // namespace trailcast::agent
