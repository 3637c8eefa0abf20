#pragma once

#include "agent/diagnosis/run_log.h"
#include "services/plot/strip_chart.h"

namespace trailcast::explain {

// How high a panel of this width has to be for the path: none without odometry, or
// where it stood.
[[nodiscard]] double PathPanelHeight(const agent::RunLog& log, double width_px);

// The path by odometry into `box`, north of nowhere: x and y are the odometry's own.
void DrawPathPanel(plot::Drawing& drawing, const plot::PixelBox& box, const agent::RunLog& log);

}  // namespace trailcast::explain
