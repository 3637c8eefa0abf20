#pragma once

#include "agent/diagnosis/run_log.h"
#include "services/image/image.h"
#include "services/plot/drawing.h"

namespace trailcast::explain {

// Draws a replay's log. The first panel has the path by odometry, coloured by the estimated offset
// from the taught path. Below are curves over the distance driven (over the frames without
// odometry): the commanded turns, the share of features that survive, and the estimate or the
// paper's delta. Fine lines are segment borders, and coloured bands show where the robot was not
// sure of its place.
[[nodiscard]] plot::Drawing DrawRun(const agent::RunLog& log);

[[nodiscard]] image::Color PhaseColor(agent::Phase phase);

}  // namespace trailcast::explain
