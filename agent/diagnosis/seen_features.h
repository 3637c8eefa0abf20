#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "services/replay/feature_verdict.h"

namespace trailcast::agent {

// A feature of a log, in pixels from the picture's upper left corner.
struct SeenFeature {
  double u_px = 0.0;
  double v_px = 0.0;
  // Where it will be at the milestone; for a rejected one, where it should be.
  double to_u_px = 0.0;
  double to_v_px = 0.0;
  replay::FeatureVerdict verdict = replay::FeatureVerdict::kInside;

  bool operator==(const SeenFeature&) const = default;
};

// Reads the bytes of a message of the topic /camera/features, which may come from anybody: it
// returns the whole features with finite numbers.
[[nodiscard]] std::vector<SeenFeature> ReadFeatures(std::span<const std::uint8_t> message);

}  // namespace trailcast::agent
