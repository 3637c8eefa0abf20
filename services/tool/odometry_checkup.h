#pragma once

#include <optional>
#include <vector>

#include "agent/device/drive_look.h"
#include "services/tool/checkup.h"

namespace trailcast::tool {

// How wide a camera sees with that focal length, of its picture's width, and the other way about.
[[nodiscard]] double FieldOfView(double focal_share);
[[nodiscard]] double FocalShare(double field_of_view_rad);

// What a drive's odometry is worth, held against its pictures, what Trailcast makes of it, and what
// to set. `field_of_view_rad`: as the drive was looked at; nothing: a usual camera's was taken.
[[nodiscard]] std::vector<Finding> JudgeOdometry(const agent::DriveLook& drive,
                                                 std::optional<double> field_of_view_rad);

}  // namespace trailcast::tool
