#include "agent/session/src/place/likeliest_place.h"

#include <algorithm>

namespace trailcast::agent {
namespace {

// A place is wrong if this many fewer features support it. If they are not far fewer in all, the
// share of those in view has to be this much less, since segments have more and less of them.
constexpr double kFarLess = 3.0;
constexpr double kFarSmaller = 0.1;
constexpr double kFarFewer = 0.8;

bool IsAboutAsGood(const PlaceByFeatures& place, const PlaceByFeatures& best) {
  return place.speaks >= best.speaks - kFarLess ||
         (place.share > best.share - kFarSmaller && place.agreeing > kFarFewer * best.agreeing);
}

}  // namespace

std::optional<LikeliestPlace> LikeliestOf(std::span<const PlaceByFeatures> compared) {
  const auto best = std::max_element(
      compared.begin(), compared.end(),
      [](const PlaceByFeatures& a, const PlaceByFeatures& b) { return a.speaks < b.speaks; });
  if (best == compared.end()) return std::nullopt;
  LikeliestPlace likeliest{*best, best->along - best->along_sigma, best->along + best->along_sigma};
  for (const PlaceByFeatures& place : compared) {
    if (!IsAboutAsGood(place, *best)) continue;
    likeliest.first = std::min(likeliest.first, place.along - place.along_sigma);
    likeliest.last = std::max(likeliest.last, place.along + place.along_sigma);
  }
  return likeliest;
}

}  // namespace trailcast::agent
