#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "services/base/result.h"
#include "services/odometry/odometry_worth.h"
#include "services/route/usual_camera.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

struct DriveLookOptions {
  vision::IntakeOptions intake;                  // how the camera is mounted
  double focal_share = route::kUsualFocalShare;  // its focal length, of its picture's width
  // Asked after each frame, with how long the drive has lasted.
  std::function<bool(double lasts_s)> enough = [](double) { return false; };
};

// A drive as its camera and its odometry have it.
struct DriveLook {
  int pictures = 0;
  bool has_odometry = false;
  double begins_s = 0.0;  // by the clock of the steps
  std::vector<odometry::DriveStep> steps;
  std::optional<odometry::CameBack> came_back;
  std::vector<std::string> news;  // as RobotDevice::TakeNews
};

// Looks at all frames that the device has, until it is enough; tells its base nothing. Errors are
// the device's.
[[nodiscard]] Result<DriveLook> LookAtDrive(RobotDevice& device, const DriveLookOptions& options);

}  // namespace trailcast::agent
