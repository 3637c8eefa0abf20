#pragma once

#include <span>
#include <vector>

#include "services/image/image.h"
#include "services/route/tracked_feature.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {

struct FeatureFinderOptions {
  // Near search: correlation of the stored pattern around the place where it is expected.
  double min_correlation = 0.70;
  // What the found ones must agree on, scout pixels (see ViewFitOptions).
  double agree_u_px = 16.0;
  double agree_v_px = 5.0;
  // At any magnification (camera at hand / scout's), in steps that a pattern bears.
  double least_magnification = 0.2;
  double most_magnification = 5.0;
};

// How far from the expected places to look, in pixels of the scout's magnification.
struct SearchRadius {
  double u_px = 28.0;
  double v_px = 14.0;
};

struct FindResult {
  // In pixels of the frame from its centre; id: position in the list that was sought.
  std::vector<route::TrackedFeature> features;
  double magnification = 1.0;  // pixels of the frame per scout's pixel, as these features say
  int in_picture = 0;          // of those sought, how many were expected to be in the picture

  // A third of what is sought can be found in agreement in any picture, and where corners are all
  // alike nearly half: so many more are found, and whether they are enough to mean something.
  [[nodiscard]] double AboveChance() const {
    return static_cast<double>(features.size()) - 0.45 * in_picture;
  }
  [[nodiscard]] bool BeyondChance() const { return AboveChance() >= 3.0; }
};

// Where a fit puts the features' taught places at fraction `s` of their segment: what FindNear
// expects.
[[nodiscard]] std::vector<route::TrackedFeature> TaughtPlaces(
    std::span<const route::Feature> sought, double s, const ViewFit& fit);

// Finds a segment's stored features in a frame of whatever camera. Deterministic, stateless.
class FeatureFinder {
 public:
  explicit FeatureFinder(const FeatureFinderOptions& options = {}) : options_(options) {}

  // By their patterns, around where each is expected (pixels of the frame from its centre; ids are
  // positions in `sought`). `magnification`: how much larger they are here than in the scout's.
  [[nodiscard]] FindResult FindNear(const image::GrayImage& frame,
                                    std::span<const route::Feature> sought,
                                    std::span<const route::TrackedFeature> expected,
                                    double magnification, const SearchRadius& radius) const;

  // The same by the scout's own kind of camera on ground that tilts it: the features found agree on
  // a roll as well, and those that were missed are sought again where the others say. Takes the
  // magnification to be as it is given.
  [[nodiscard]] FindResult FindTilted(const image::GrayImage& frame,
                                      std::span<const route::Feature> sought,
                                      std::span<const route::TrackedFeature> expected,
                                      double magnification, const SearchRadius& radius) const;

  // The same by a robot that stands where the scout stood at fraction `s` of the segment, give or
  // take the radius, and whose camera nothing is known of: at every magnification. `growth`: how
  // much larger the patterns are there than where the scout took them. Nothing found that is not
  // beyond chance.
  [[nodiscard]] FindResult FindAtAnyMagnification(const image::GrayImage& frame,
                                                  std::span<const route::Feature> sought, double s,
                                                  const SearchRadius& radius,
                                                  double growth = 1.0) const;

 private:
  FeatureFinderOptions options_;
};

}  // namespace trailcast::vision
