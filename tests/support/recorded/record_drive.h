#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "services/base/time.h"
#include "services/image/files.h"
#include "tests/support/recorded/bag_writers.h"
#include "tests/support/recorded/ros_messages.h"

namespace trailcast::test {

// Records a folder of pictures as a robot's recorder would: twenty a second, with odometry,
// twenty-five a second, of wheels that drive about half a metre a second. That is no round number,
// so that no threshold is met exactly, where rounding decides.
struct RecordedDrive {
  std::filesystem::path frames;
  bool compressed = false;  // pictures as in the files; otherwise decoded, grey
  bool odometry = true;
};
inline constexpr double kDriveRate_hz = 20.0;
inline constexpr double kOdometryRate_hz = 25.0;
inline constexpr std::chrono::nanoseconds kDriveBegan = std::chrono::seconds(1'700'000'000);

inline std::chrono::nanoseconds WheelsAt(int sample) {
  return FromSeconds(sample / kOdometryRate_hz);
}
inline motion::Pose2 DrivenPose(std::chrono::nanoseconds since) {
  return {0.4871 * std::chrono::duration<double>(since).count(), 0.0, 0.0};
}

inline std::vector<std::filesystem::path> PicturesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline void RecordDrive(const RecordedDrive& drive, BagWriter& bag) {
  const auto files = PicturesOf(drive.frames);
  int wheels = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    // This is what --rate gives, to the nanosecond.
    const std::chrono::nanoseconds at = FromSeconds(static_cast<double>(i) / kDriveRate_hz);
    while (drive.odometry && WheelsAt(wheels - 1) < at) {
      const std::chrono::nanoseconds turned_at = WheelsAt(wheels++);
      bag.Put("/odom", "nav_msgs/msg/Odometry", kDriveBegan + turned_at,
              OdometryMessage(kDriveBegan + turned_at, DrivenPose(turned_at)));
    }
    if (drive.compressed) {
      bag.Put("/camera/image_raw/compressed", "sensor_msgs/msg/CompressedImage", kDriveBegan + at,
              CompressedImageMessage(kDriveBegan + at, ReadBytes(files[i])));
      continue;
    }
    const auto picture = image::ReadGray(files[i]);
    if (!picture) throw std::runtime_error(picture.error().message);
    bag.Put("/camera/image_raw", "sensor_msgs/msg/Image", kDriveBegan + at,
            ImageMessage(kDriveBegan + at, *picture));
  }
}

// Writes the same odometry as CSV, for as many frames.
inline void WriteOdometry(std::size_t frames, const std::filesystem::path& file) {
  std::ofstream stream(file);
  stream << "t_s,x_m,y_m,heading_rad\n";
  const auto end = FromSeconds(static_cast<double>(frames) / kDriveRate_hz);
  for (int sample = 0; WheelsAt(sample - 1) < end; ++sample) {
    stream << fmt::format("{:.17g},{:.17g},0,0\n", sample / kOdometryRate_hz,
                          DrivenPose(WheelsAt(sample)).x_m);
  }
}

}  // namespace trailcast::test
