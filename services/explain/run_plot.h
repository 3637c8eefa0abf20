#pragma once

#include "agent/diagnosis/run_log.h"
#include "services/image/image.h"
#include "services/plot/drawing.h"

namespace trailcast::explain {

// A replay's log as a picture: the path by odometry, coloured by the estimated place beside it;
// below, over the distance driven (or the frames, without odometry), the turns asked for, the share
// of the features that survive, and the estimate, or the paper's delta. Fine lines are segment
// borders, coloured bands where the robot was not sure.
[[nodiscard]] plot::Drawing DrawRun(const agent::RunLog& log);

[[nodiscard]] image::Color PhaseColor(agent::Phase phase);

}  // namespace trailcast::explain
