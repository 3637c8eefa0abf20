#pragma once

#include "services/image/canvas.h"
#include "services/replay/feature_verdict.h"

namespace trailcast::agent {

// Pictures and logs draw a verdict's feature in this colour.
[[nodiscard]] image::Color VerdictColor(replay::FeatureVerdict verdict);

}  // namespace trailcast::agent
