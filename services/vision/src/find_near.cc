#include "services/route/track.h"
#include "services/vision/feature_finder.h"
#include "services/vision/src/frame.h"
#include "services/vision/src/pattern_search.h"

namespace trailcast::vision {

std::vector<route::TrackedFeature> TaughtPlaces(std::span<const route::Feature> sought, double s,
                                                const ViewFit& fit) {
  std::vector<route::TrackedFeature> places;
  places.reserve(sought.size());
  for (std::size_t i = 0; i < sought.size(); ++i) {
    const route::TrackKnot taught = route::TaughtPlace(sought[i], s);
    places.push_back({static_cast<int>(i), fit.MapU(taught.u_px), fit.MapV(taught.v_px)});
  }
  return places;
}

FindResult FeatureFinder::FindNear(const image::GrayImage& frame,
                                   std::span<const route::Feature> sought,
                                   std::span<const route::TrackedFeature> expected,
                                   double magnification, const SearchRadius& radius) const {
  const PatternMatches matches =
      SeekPatterns(View(frame), sought, expected, magnification, radius, options_.min_correlation);
  ViewFitOptions agree;
  agree.min_scale = 0.7;
  agree.max_scale = 1.4;
  agree.tolerance_u_px = options_.agree_u_px;
  agree.tolerance_v_px = options_.agree_v_px;
  const ViewFitResult agreed = FitView(matches.pairs, agree);
  FindResult result;
  result.in_picture = matches.in_picture;
  result.magnification = agreed.fit.scale * magnification;
  for (std::size_t i = 0; i < matches.pairs.size(); ++i) {
    if (!agreed.inlier[i]) continue;
    const ViewPair& pair = matches.pairs[i];
    result.features.push_back(
        {matches.ids[i], pair.u_px * matches.scale, pair.v_px * matches.scale});
  }
  return result;
}

}  // namespace trailcast::vision
