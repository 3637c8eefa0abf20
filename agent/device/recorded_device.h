#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "agent/device/odometry_file.h"
#include "services/image/files.h"

namespace trailcast::agent {

struct RecordedRun {
  std::filesystem::path frames;         // a folder of pictures or a video
  std::filesystem::path odometry;       // empty for a run without odometry
  std::optional<double> rate_hz;        // nothing stands for the video's own, or kDefaultRate_hz
  std::filesystem::path frame_times{};  // a CSV with t_s; if empty, the rate counts
};

// A recorded run, read as fast as possible. Pictures that cannot be read are left out and counted
// (image::FrameSequence); those after them keep their times. Pictures larger than anybody looks at
// may be decoded smaller. Commands have no effect.
class RecordedDevice final : public RobotDevice {
 public:
  static constexpr double kDefaultRate_hz = 30.0;

  // Reads the first frame, so that an unusable run is found before anything starts.
  [[nodiscard]] static Result<std::unique_ptr<RecordedDevice>> Open(const RecordedRun& run);

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand&) override { return {}; }
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override;

  [[nodiscard]] bool has_odometry() const { return odometry_.has_value(); }
  [[nodiscard]] double rate_hz() const { return rate_hz_; }
  // Returns the number of the frame that Next gave last, from 0. Frames that cannot be read count.
  [[nodiscard]] int frame() const { return frame_; }
  // Returns "30 frames a second" or "frames by their own times", for people.
  [[nodiscard]] std::string timing() const;
  [[nodiscard]] int width_px() const { return width_; }  // of the camera's pictures

 private:
  RecordedDevice(std::unique_ptr<image::FrameSequence> frames, image::GrayImage first,
                 std::optional<OdometryFile> odometry, double rate_hz);

  [[nodiscard]] Result<void> ReadFrameTimes(const std::filesystem::path& file);
  [[nodiscard]] Result<SensorTime> StampOfFrame() const;
  void TellNews();

  std::unique_ptr<image::FrameSequence> frames_;
  std::optional<image::GrayImage> first_;  // until Next returns it
  int width_;
  int height_;
  std::optional<OdometryFile> odometry_;
  double rate_hz_;
  std::filesystem::path times_file_;
  std::vector<SensorTime> times_;  // of the frames; if empty, the rate counts
  int frame_ = 0;
};

}  // namespace trailcast::agent
