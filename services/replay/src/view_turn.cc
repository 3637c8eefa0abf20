#include "services/replay/view_turn.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace trailcast::replay {
namespace {

// Returns how much further to the right the features are than in the key view. It is the median, so
// a few mismatches and near features on one side do not move it.
double MedianShift_px(const std::vector<FunnelPair>& pairs) {
  std::vector<double> shifts_px;
  shifts_px.reserve(pairs.size());
  for (const FunnelPair& pair : pairs) shifts_px.push_back(pair.current_u_px - pair.milestone_u_px);
  const auto middle = shifts_px.begin() + static_cast<std::ptrdiff_t>(shifts_px.size() / 2);
  std::nth_element(shifts_px.begin(), middle, shifts_px.end());
  return *middle;
}

}  // namespace

ViewTurn TurnTowards(double aim, std::span<const SeenKeyView> seen, int scout_width_px,
                     const ViewTurnOptions& options) {
  const SeenKeyView* before = nullptr;
  const SeenKeyView* after = nullptr;
  // The nearest one counts and, of those at one place, the best recognised one.
  const auto rank = [&](const SeenKeyView& view) {
    return std::pair(std::abs(view.along - aim), -std::ssize(view.pairs));
  };
  for (const SeenKeyView& view : seen) {
    if (static_cast<int>(view.pairs.size()) < options.fewest_pairs) continue;
    const SeenKeyView*& nearest = view.along <= aim ? before : after;
    if (nearest == nullptr || rank(view) < rank(*nearest)) nearest = &view;
  }
  if (before == nullptr) std::swap(before, after);
  if (before == nullptr) return {};
  double shift_px = MedianShift_px(before->pairs);
  auto features = before->pairs.size();
  if (after != nullptr) {
    const double weight = (aim - before->along) / (after->along - before->along);
    shift_px += weight * (MedianShift_px(after->pairs) - shift_px);
    features = std::max(features, after->pairs.size());
  }
  const double gain = options.gain_rad_per_px_at_320 * 320.0 / scout_width_px;
  const double turn_rad = std::clamp(gain * shift_px, -options.largest_rad, options.largest_rad);
  return {turn_rad, static_cast<int>(features)};
}

}  // namespace trailcast::replay
