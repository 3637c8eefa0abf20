#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "services/route/track.h"
#include "services/vision/feature_finder.h"
#include "services/vision/view_fit.h"

namespace trailcast::vision {
namespace {

constexpr double kStep = 1.12;  // a pattern tolerates about half of this in either direction
constexpr std::size_t kFewestToFit = 4;
// These are for a second search, near where the first one's fit puts the features.
constexpr double kCloserRadius = 0.27;  // of the first search's
constexpr double kCloserAgreement = 0.6;
constexpr double kCloserCorrelation = 0.75;

// Returns the fit from the taught places to those found, if there is one.
std::optional<ViewFit> FitTo(const FindResult& found, std::span<const route::Feature> sought,
                             double s) {
  std::vector<ViewPair> pairs;
  pairs.reserve(found.features.size());
  for (const route::TrackedFeature& feature : found.features) {
    const route::TrackKnot taught =
        route::TaughtPlace(sought[static_cast<std::size_t>(feature.id)], s);
    pairs.push_back({taught.u_px, taught.v_px, feature.u_px, feature.v_px});
  }
  ViewFitOptions options;
  options.min_scale = found.magnification / (kStep * kStep);
  options.max_scale = found.magnification * kStep * kStep;
  options.tolerance_u_px *= found.magnification;
  options.tolerance_v_px *= found.magnification;
  const ViewFitResult fitted = FitView(pairs, options);
  return fitted.inliers > 0 ? std::optional(fitted.fit) : std::nullopt;
}

}  // namespace

FindResult FeatureFinder::FindAtAnyMagnification(const image::GrayImage& frame,
                                                 std::span<const route::Feature> sought, double s,
                                                 const SearchRadius& radius, double growth) const {
  FeatureFinderOptions options = options_;
  options.agree_u_px *= kCloserAgreement;
  options.agree_v_px *= kCloserAgreement;
  options.min_correlation = std::max(options.min_correlation, kCloserCorrelation);
  const auto find = [&](const FeatureFinder& finder, const ViewFit& fit,
                        const SearchRadius& within) {
    FindResult found =
        finder.FindNear(frame, sought, TaughtPlaces(sought, s, fit), growth * fit.scale, within);
    found.magnification /= growth;
    return found;
  };
  const FeatureFinder closer(options);
  FindResult best;
  for (double magnification = options_.least_magnification;
       magnification <= options_.most_magnification; magnification *= kStep) {
    const FindResult coarse = find(*this, {magnification, 0.0, 0.0}, radius);
    if (coarse.features.size() < kFewestToFit) continue;
    const std::optional<ViewFit> fit = FitTo(coarse, sought, s);
    if (!fit) continue;
    FindResult found =
        find(closer, *fit, {kCloserRadius * radius.u_px, kCloserRadius * radius.v_px});
    if (found.BeyondChance() && found.AboveChance() > best.AboveChance()) best = std::move(found);
  }
  return best;
}

}  // namespace trailcast::vision
