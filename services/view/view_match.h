#pragma once

#include <span>

#include "services/route/key_view.h"
#include "services/route/route.h"

namespace trailcast::view {

struct ViewMatch {
  // One view in 800 of other worlds agrees so well with any of 100 000 segments.
  static constexpr int kEnough = 6;

  // Counts features that look alike and lie where one magnification and one shift of the picture
  // put them.
  int agreed = 0;
  double likeness = 0.0;  // the same, weighted by how well they agree: 0 to agreed

  [[nodiscard]] bool found() const { return agreed >= kEnough; }
  // Returns 0 to 1; it is one half if ten agree perfectly.
  [[nodiscard]] double score() const { return likeness / (likeness + 10.0); }
};

// Returns the best match of a view among a stored segment's key views. The width of a picture is
// taken to be what its features span. The result is deterministic.
[[nodiscard]] ViewMatch Match(std::span<const route::ViewFeature> view,
                              const route::Segment& segment);

}  // namespace trailcast::view
