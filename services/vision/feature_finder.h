#pragma once

#include <span>
#include <vector>

#include "services/image/image.h"
#include "services/route/tracked_feature.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {

struct FeatureFinderOptions {
  // The near search correlates the stored pattern around the place where it is expected.
  double min_correlation = 0.70;
  // The tolerances within which the features found must agree, in the scout's pixels (see
  // ViewFitOptions).
  double agree_u_px = 16.0;
  double agree_v_px = 5.0;
  // The magnifications (this camera's to the scout's) among which FindAtAnyMagnification searches,
  // in steps that a pattern tolerates.
  double least_magnification = 0.2;
  double most_magnification = 5.0;
};

// How far from the expected places the search reaches, in pixels of the scout's magnification.
struct SearchRadius {
  double u_px = 28.0;
  double v_px = 14.0;
};

struct FindResult {
  // Coordinates are in pixels of the frame from its centre; an id is a position in the list that
  // was sought.
  std::vector<route::TrackedFeature> features;
  double magnification = 1.0;  // the frame's pixels per pixel of the scout's, by these features
  int in_picture = 0;          // how many of the features sought were expected in the picture

  // Returns by how many features the result exceeds chance. In any picture a third of the features
  // sought can be found in agreement, and nearly half where corners look alike.
  [[nodiscard]] double AboveChance() const {
    return static_cast<double>(features.size()) - 0.45 * in_picture;
  }
  [[nodiscard]] bool BeyondChance() const { return AboveChance() >= 3.0; }
};

// Returns where a fit puts the features' taught places at fraction `s` of their segment, as
// FindNear expects them.
[[nodiscard]] std::vector<route::TrackedFeature> TaughtPlaces(
    std::span<const route::Feature> sought, double s, const ViewFit& fit);

// Finds a segment's stored features in a frame of any camera. It is deterministic and stateless.
class FeatureFinder {
 public:
  explicit FeatureFinder(const FeatureFinderOptions& options = {}) : options_(options) {}

  // Finds features by their patterns, around where each is expected (pixels of the frame from its
  // centre; ids are positions in `sought`). `magnification` is how much larger they appear here
  // than in the scout's camera.
  [[nodiscard]] FindResult FindNear(const image::GrayImage& frame,
                                    std::span<const route::Feature> sought,
                                    std::span<const route::TrackedFeature> expected,
                                    double magnification, const SearchRadius& radius) const;

  // Finds features with a camera of the scout's kind on ground that tilts it. The features found
  // agree on a roll as well, and those that were missed are sought again where the others put them.
  // The magnification is fixed.
  [[nodiscard]] FindResult FindTilted(const image::GrayImage& frame,
                                      std::span<const route::Feature> sought,
                                      std::span<const route::TrackedFeature> expected,
                                      double magnification, const SearchRadius& radius) const;

  // Finds features at every magnification, for a robot that stands where the scout stood at
  // fraction `s` of the segment, give or take the radius, and whose camera is not known. `growth`
  // is how much larger the patterns appear there than where the scout took them. A result that
  // chance explains is empty.
  [[nodiscard]] FindResult FindAtAnyMagnification(const image::GrayImage& frame,
                                                  std::span<const route::Feature> sought, double s,
                                                  const SearchRadius& radius,
                                                  double growth = 1.0) const;

 private:
  FeatureFinderOptions options_;
};

}  // namespace trailcast::vision
