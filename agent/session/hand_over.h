#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "services/image/image.h"
#include "services/replay/follower.h"
#include "services/route/tracked_feature.h"
#include "services/vision/feature_finder.h"
#include "services/vision/view_fit.h"

namespace trailcast::agent {

// Finds a segment's stored features in the follower's picture, whatever its camera, and learns how
// the two cameras' magnifications compare.
class HandOver {
 public:
  // `any_camera`: look for other magnifications too; false for the paper's method, which takes the
  // cameras to be alike.
  HandOver(bool any_camera, int scout_width_px)
      : any_camera_(any_camera), scout_width_px_(scout_width_px) {}

  // How the scout's picture maps onto this one by what is recognised, as a function that is called
  // only where the features are not found as they were expected; nothing: nothing is recognised.
  using Recognise = std::function<std::optional<vision::ViewFit>()>;

  // The features of the segment that `follower` has just begun, in the follower's pixels. Tells the
  // follower the magnification it saw.
  [[nodiscard]] std::vector<route::TrackedFeature> ToSegment(const image::GrayImage& frame,
                                                             replay::Follower& follower,
                                                             const Recognise& recognise);

  // A segment's features as a robot sees them that stands at its fraction `s`; without a
  // `magnification`, at any that finds them. `grown`: their patterns as much larger as the features
  // are there; finds them late in a segment before a near wall, and elsewhere tells the place less
  // exactly.
  [[nodiscard]] vision::FindResult SeeFrom(const image::GrayImage& frame,
                                           const route::Segment& segment, double s,
                                           std::optional<double> magnification, bool grown) const;
  // What was seen so counts as the hand-over to the segment that `follower` has just begun.
  void TakeUp(const vision::FindResult& seen, replay::Follower& follower);

  // The same features once more, when tracking has lost many.
  [[nodiscard]] std::vector<route::TrackedFeature> Again(const image::GrayImage& frame,
                                                         const replay::Follower& follower) const;

  // The features of any segment, for a robot that lost its own, or never had any: seen from its
  // fraction `s`, as they are expected by the follower's magnification, or by what is recognised.
  // Tells the follower the magnification that it saw. Nothing if they are too few to go on with.
  [[nodiscard]] std::vector<route::TrackedFeature> Recover(
      const image::GrayImage& frame, replay::Follower& follower, const route::Segment& segment,
      double s, const std::optional<vision::ViewFit>& recognised);

  // Of a run that goes on: what the one before had learnt.
  void KnowMagnification(double magnification);
  // What all of the run so far has recognised: magnifications far from it are not believed.
  void SetRunMagnification(double magnification) { recognised_magnification_ = magnification; }

  // Whether the last ToSegment found them by a search of the whole picture.
  [[nodiscard]] bool last_was_wide() const { return last_was_wide_; }
  // Share of stored features found, mean over the hand-overs so far.
  [[nodiscard]] double found_share() const { return count_ > 0 ? share_sum_ / count_ : 0.0; }
  [[nodiscard]] int count() const { return count_; }

 private:
  [[nodiscard]] vision::FindResult FindNear(const image::GrayImage& frame,
                                            const route::Segment& segment,
                                            std::span<const route::TrackedFeature> expected,
                                            double magnification, double within_px_at_320) const;
  [[nodiscard]] vision::FindResult FindAnywhere(
      const image::GrayImage& frame, const route::Segment& segment, double s,
      const std::optional<vision::ViewFit>& recognised) const;
  [[nodiscard]] bool Plausible(double magnification) const;
  void Learn(const vision::FindResult& found, replay::Follower& follower);

  vision::FeatureFinder finder_;
  bool any_camera_;
  int scout_width_px_;
  std::deque<double> seen_magnifications_;
  std::optional<double> recognised_magnification_;
  bool last_was_wide_ = false;
  double share_sum_ = 0.0;
  int count_ = 0;
};

}  // namespace trailcast::agent
