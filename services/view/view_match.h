#pragma once

#include <span>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::view {

struct ViewMatchOptions {
  int max_hamming_bits = 64;    // of 256
  double hamming_ratio = 0.85;  // best to second best
  // What the places must agree on: half a picture's width times this.
  double agree_u = 0.06;
  double agree_v = 0.04;
  // Magnification, the camera at hand against the scout's.
  double least_scale = 0.6;
  double most_scale = 1.7;
};

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

// Compares a view with a stored segment, feature by feature, at five places along it.
// Deterministic. Fewer than kEnough alike: nothing.
[[nodiscard]] ViewMatch Match(std::span<const route::ViewFeature> view,
                              const route::Segment& segment, const ViewMatchOptions& options = {});

}  // namespace trailcast::view
