#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "agent/device/recorded_poses.h"
#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Wheel odometry of a recorded run: poses at rising times, in seconds after the run's first frame,
// or by the clock of its frames' own times.
class OdometryFile {
 public:
  // Reads CSV with the header `t_s,x_m,y_m,heading_rad`; further columns are ignored. Errors name
  // the file, the line and what was expected there.
  [[nodiscard]] static Result<OdometryFile> Read(const std::filesystem::path& file);

  // Returns the interpolated pose at `time`. Up to kSlack before the first and after the last row,
  // the nearest row holds; beyond that, the error is kInvalidArgument.
  [[nodiscard]] Result<motion::Pose2> At(SensorTime time) const;

  // See RecordedPoses.
  [[nodiscard]] motion::OdometryIncrement TakeUnknown(SensorTime until,
                                                      std::vector<std::string>& news) {
    return poses_.TakeUnknown(until, news);
  }

  static constexpr double kSlack_s = 0.5;

 private:
  OdometryFile(std::filesystem::path file, RecordedPoses poses)
      : file_(std::move(file)), poses_(std::move(poses)) {}

  std::filesystem::path file_;
  RecordedPoses poses_;
};

}  // namespace trailcast::agent
