#pragma once

#include <optional>
#include <vector>

#include "agent/device/drive_look.h"
#include "services/tool/checkup.h"

namespace trailcast::tool {

// These convert a focal length, as a share of the picture's width, to the camera's field of view,
// and back.
[[nodiscard]] double FieldOfView(double focal_share);
[[nodiscard]] double FocalShare(double field_of_view_rad);

// Judges a drive's odometry against its pictures, what Trailcast makes of it, and what to set.
// `field_of_view_rad` is the one that the drive was examined with; without it a usual camera's was
// assumed.
[[nodiscard]] std::vector<Finding> JudgeOdometry(const agent::DriveLook& drive,
                                                 std::optional<double> field_of_view_rad);

}  // namespace trailcast::tool
