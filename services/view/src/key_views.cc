#include "services/view/key_views.h"

#include <array>

#include "services/route/track.h"

namespace trailcast::view {

std::vector<route::KeyView> KeyViewsOf(const route::Segment& segment) {
  constexpr std::array kPlaces = {0.0, 0.5, 1.0};
  if (!segment.key_views.empty()) return segment.key_views;
  std::vector<route::KeyView> views;
  for (const double s : kPlaces) {
    route::KeyView view{s, {}};
    for (const route::Feature& feature : segment.features) {
      if (!route::IsDescribed(feature.descriptor)) continue;
      const route::TrackKnot place = route::TaughtPlace(feature, s);
      view.features.push_back({feature.descriptor, place.u_px, place.v_px, 0.0F});
    }
    if (!view.features.empty()) views.push_back(std::move(view));
  }
  return views;
}

std::vector<route::KeyView> ScoutViewsOf(const route::Segment& segment) {
  std::vector<route::KeyView> views = KeyViewsOf(segment);
  std::erase_if(views, [](const route::KeyView& view) { return view.missed.has_value(); });
  return views;
}

}  // namespace trailcast::view
