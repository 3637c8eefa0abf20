#include "agent/session/src/place/likeliest_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

// A place is wrong if this many fewer features support it. If they are not far fewer in all, the
// share of those in view has to be this much less, since segments have more and less of them.
constexpr double kFarLess = 3.0;
constexpr double kFarSmaller = 0.1;
constexpr double kFarFewer = 0.8;
// The robot may begin this far before the route's beginning, or beyond its end. Further off it is
// not on the route.
constexpr double kOutside = 1.0;

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

std::string InWords(double way, const RouteExtent& route) {
  if (route.metric) return fmt::format("{:.1f} m", way);
  return fmt::format("{:.0f} % of the route", 100.0 * way / route.length);
}

Beginning BeginningBy(std::span<const PlaceByFeatures> compared, int enough,
                      const RouteExtent& route) {
  const auto likeliest = LikeliestOf(compared);
  if (!likeliest || likeliest->best.agreeing < enough) return {};
  const auto& [best, first, last] = *likeliest;
  if (last - first > kOnePlace) {
    return {{},
            fmt::format("from {} to {} along the route it looks alike: begin where more is near, "
                        "or at the beginning",
                        InWords(std::max(0.0, first), route),
                        InWords(std::min(route.length, last), route))};
  }
  const double along = std::clamp(best.along, 0.0, route.length);
  const double outside = std::abs(best.along - along);
  if (outside > kOutside) {
    return {{},
            fmt::format("what it sees is of the route, from {} {}: put it on the route",
                        InWords(outside, route),
                        best.along < along ? "before its beginning" : "beyond its end")};
  }
  return {likeliest, ""};
}

}  // namespace trailcast::agent
