#include "services/view/view_match.h"

#include <algorithm>
#include <cmath>

#include "services/view/key_views.h"
#include "services/view/src/spanned_width.h"
#include "services/view/view_table.h"

namespace trailcast::view {
double SpannedWidth_px(std::span<const route::ViewFeature> view) {
  double half_width_px = 1.0;
  for (const route::ViewFeature& feature : view) {
    half_width_px = std::max(half_width_px, static_cast<double>(std::abs(feature.u_px)));
  }
  return 2.0 * half_width_px;
}

ViewMatch Match(std::span<const route::ViewFeature> view, const route::Segment& segment) {
  const ViewTable seen = Tabulate(view, SpannedWidth_px(view));
  ViewMatch best;
  for (const route::KeyView& key : KeyViewsOf(segment)) {
    const Comparison comparison =
        Compare(Tabulate(key.features, SpannedWidth_px(key.features)), seen);
    if (comparison.likeness > best.likeness) {
      best = {comparison.agreed(), comparison.likeness};
    }
  }
  return best;
}

}  // namespace trailcast::view
