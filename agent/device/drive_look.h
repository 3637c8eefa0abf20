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
  double focal_share = route::kUsualFocalShare;  // its focal length, as a share of its picture's
                                                 // width
  // Called after each frame with the duration of the drive so far.
  std::function<bool(double lasts_s)> enough = [](double) { return false; };
};

// A drive by its camera and its odometry.
struct DriveLook {
  int pictures = 0;
  bool has_odometry = false;
  double begins_s = 0.0;  // by the clock of the steps
  std::vector<odometry::DriveStep> steps;
  std::optional<odometry::CameBack> came_back;
  std::vector<std::string> news;  // as from RobotDevice::TakeNews
};

// Takes the device's frames until there are enough, and sends no commands. Errors are the device's.
[[nodiscard]] Result<DriveLook> LookAtDrive(RobotDevice& device, const DriveLookOptions& options);

}  // namespace trailcast::agent
