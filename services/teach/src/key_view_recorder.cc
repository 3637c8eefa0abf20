#include "services/teach/key_view_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::teach {

route::View KeyViewRecorder::Choose(const route::View& view) const {
  route::View middle;
  route::View rest;
  for (const route::ViewFeature& feature : view) {
    const bool inside =
        std::abs(feature.u_px) < 0.25 * width_px_ && std::abs(feature.v_px) < 0.19 * width_px_;
    (inside ? middle : rest).push_back(feature);
  }
  route::View chosen = view::Spread(middle, options_.middle_features);
  for (const route::ViewFeature& feature : middle) {
    if (std::find(chosen.begin(), chosen.end(), feature) == chosen.end()) rest.push_back(feature);
  }
  const route::View others = view::Spread(rest, options_.features - chosen.size());
  chosen.insert(chosen.end(), others.begin(), others.end());
  return chosen;
}

bool KeyViewRecorder::Keep(const route::View& view) {
  recognised_ = 0.0;
  if (view.size() < options_.fewest) return false;
  kept_ = options_.middle_features > 0 ? Choose(view) : view::Spread(view, options_.features);
  const bool fewer = options_.compared < options_.features;
  table_ = view::Tabulate(fewer ? view::Spread(view, options_.compared) : kept_, width_px_);
  recognised_ = 1.0;
  since_kept_ = 0;
  return true;
}

bool KeyViewRecorder::Add(const route::View& view) {
  constexpr double kRelated = 0.15;  // share in two successive pictures; chance gives less
  weakness_ = view.size() < options_.fewest ? ViewWeakness::kBland : ViewWeakness::kNone;
  if (kept_.empty()) return Keep(view);
  ++since_kept_;
  const int agreed = view::Compare(table_, view::Tabulate(view, width_px_)).agreed();
  const double share = agreed / static_cast<double>(std::min(kept_.size(), options_.compared));
  if (share >= options_.recognised_share) {
    recognised_ = share;
    return false;
  }
  if (weakness_ == ViewWeakness::kNone && since_kept_ == 1 && share < kRelated) {
    weakness_ = ViewWeakness::kUnrelated;
  }
  const bool kept = Keep(view);
  recognised_ = share;
  return kept;
}

}  // namespace trailcast::teach
