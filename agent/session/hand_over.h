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

// This finds a segment's stored features in the follower's picture, whatever its camera, and learns
// how the two cameras' magnifications compare.
class HandOver {
 public:
  // `any_camera` searches other magnifications too. It is false for the paper's method, which
  // assumes equal cameras.
  HandOver(bool any_camera, int scout_width_px)
      : any_camera_(any_camera), scout_width_px_(scout_width_px) {}

  // This returns how the scout's picture maps onto this one by what is recognised, or nothing if
  // nothing is. It is called only if the features are not found where they were expected.
  using Recognise = std::function<std::optional<vision::ViewFit>()>;

  // Returns the features of the segment that `follower` has just begun, in the follower's pixels,
  // and tells the follower the magnification it saw.
  [[nodiscard]] std::vector<route::TrackedFeature> ToSegment(const image::GrayImage& frame,
                                                             replay::Follower& follower,
                                                             const Recognise& recognise);

  // Returns a segment's features as a robot at its fraction `s` sees them. Without a
  // `magnification` it tries all. `grown` scales their patterns to the features' size there; this
  // finds them late in a segment before a near wall, and elsewhere tells the place less exactly.
  [[nodiscard]] vision::FindResult SeeFrom(const image::GrayImage& frame,
                                           const route::Segment& segment, double s,
                                           std::optional<double> magnification, bool grown) const;
  // Takes `seen` as the hand-over to the segment that `follower` has just begun.
  void TakeUp(const vision::FindResult& seen, replay::Follower& follower);

  // Finds the same features once more after tracking has lost many.
  [[nodiscard]] std::vector<route::TrackedFeature> Again(const image::GrayImage& frame,
                                                         const replay::Follower& follower) const;

  // Returns the features of any segment, seen from its fraction `s`, for a robot that lost its own
  // or never had any. They are expected by the follower's magnification, or by what is recognised.
  // It tells the follower the magnification that it saw. It returns nothing if they are too few to
  // go on with.
  [[nodiscard]] std::vector<route::TrackedFeature> Recover(
      const image::GrayImage& frame, replay::Follower& follower, const route::Segment& segment,
      double s, const std::optional<vision::ViewFit>& recognised);

  // Takes over what an earlier run had learnt.
  void KnowMagnification(double magnification);
  // Sets the magnification that the whole run so far has recognised. Magnifications far from it are
  // not believed.
  void SetRunMagnification(double magnification) { recognised_magnification_ = magnification; }

  // Tells that the last ToSegment found them by a search of the whole picture.
  [[nodiscard]] bool last_was_wide() const { return last_was_wide_; }
  // Returns the share of stored features that were found, as a mean over the hand-overs so far.
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
