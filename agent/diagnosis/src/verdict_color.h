#pragma once

#include "services/image/canvas.h"
#include "services/replay/feature_verdict.h"

namespace trailcast::agent {

// Of its feature, in pictures and in logs.
[[nodiscard]] image::Color VerdictColor(replay::FeatureVerdict verdict);

}  // namespace trailcast::agent
