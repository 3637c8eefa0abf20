#pragma once

#include <span>

#include "services/route/key_view.h"
#include "services/route/route.h"

namespace trailcast::view {

struct ViewMatch {
  // One view in 800 of other worlds agrees so well with any of 100 000 segments.
  static constexpr int kEnough = 6;

  // Features that look alike and lie where one magnification and one shift of the picture put them.
  int agreed = 0;
  double likeness = 0.0;  // the same, weighed by how well they agree: 0 to agreed

  [[nodiscard]] bool found() const { return agreed >= kEnough; }
  // 0 to 1: half where ten agree perfectly.
  [[nodiscard]] double score() const { return likeness / (likeness + 10.0); }
};

// Compares a view with a stored segment's key views; the likest of them. The pictures' widths are
// taken to be what the features span. Deterministic.
[[nodiscard]] ViewMatch Match(std::span<const route::ViewFeature> view,
                              const route::Segment& segment);

}  // namespace trailcast::view
