#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/lab/sim/core/camera.h"

namespace trailcast::agent {

// Reads a camera from TOML: width, height (pixels), model ("pinhole", "fisheye", "omni"), hfov_deg,
// distortion, height_m, yaw_deg, pitch_deg, roll_deg, ahead_m, centre_u, centre_v, knock_yaw_deg,
// knock_at_s, exposure_swing, exposure_period_s, readout_s, name. Missing keys are as CameraModel
// has them; a missing name is the file's. Unknown keys are errors that list the accepted ones.
[[nodiscard]] Result<sim::CameraModel> ReadCameraFile(const std::filesystem::path& file);

// Returns a built-in camera by its name, or one from a file ending in .toml. Changes may follow by
// the same keys: "webcam+roll_deg=180+ahead_m=0.3".
[[nodiscard]] Result<sim::CameraModel> CameraFromWord(const std::string& word);

}  // namespace trailcast::agent
