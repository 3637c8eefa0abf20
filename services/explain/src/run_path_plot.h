#pragma once

#include "agent/diagnosis/run_log.h"
#include "services/plot/strip_chart.h"

namespace trailcast::explain {

// Returns the height that a panel of this width needs for the path, or 0 without odometry or if the
// robot did not move.
[[nodiscard]] double PathPanelHeight(const agent::RunLog& log, double width_px);

// Draws the path by odometry into `box`. The axes are the odometry's own x and y.
void DrawPathPanel(plot::Drawing& drawing, const plot::PixelBox& box, const agent::RunLog& log);

}  // namespace trailcast::explain
