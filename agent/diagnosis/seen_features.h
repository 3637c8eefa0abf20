#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "services/replay/feature_verdict.h"

namespace trailcast::agent {

// A feature as a log has it, in pixels from the picture's upper left corner.
struct SeenFeature {
  double u_px = 0.0;
  double v_px = 0.0;
  // Where it will be at the milestone; of a rejected one, where it should be.
  double to_u_px = 0.0;
  double to_v_px = 0.0;
  replay::FeatureVerdict verdict = replay::FeatureVerdict::kInside;

  bool operator==(const SeenFeature&) const = default;
};

// Of the bytes of a message of the topic /camera/features, which may be anybody's: what is whole,
// and no number that is none.
[[nodiscard]] std::vector<SeenFeature> ReadFeatures(std::span<const std::uint8_t> message);

}  // namespace trailcast::agent
