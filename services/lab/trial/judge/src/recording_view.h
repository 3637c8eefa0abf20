#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/odometry_file.h"
#include "agent/device/recorded_device.h"
#include "agent/session/observation.h"
#include "services/base/result.h"
#include "services/lab/trial/recording/odometry_noise.h"
#include "services/lab/trial/recording/ordered_frames.h"
#include "services/lab/trial/recording/picture_change.h"

namespace trailcast::trial {

// The view of a robot that drives as a recording shows it, with disturbances.
class RecordingView {
 public:
  [[nodiscard]] static Result<RecordingView> Open(const agent::RecordedRun& run,
                                                  const Disturbance& disturbance,
                                                  const OdometryNoise& noise, std::uint64_t seed);

  // Returns the next observation, or nothing at the end. Frames come at the recording's rate,
  // whatever their order. Odometry follows the motion that the frames show, and ignores cuts.
  [[nodiscard]] Result<std::optional<agent::Observation>> Next();

  [[nodiscard]] const std::vector<Shown>& order() const { return frames_.order(); }
  // See FrameSequence.
  [[nodiscard]] std::vector<std::string> TakeNews() { return frames_.TakeNews(); }
  [[nodiscard]] double rate_hz() const { return rate_hz_; }
  // These are of the undisturbed recording.
  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int recorded_frames() const { return recorded_frames_; }

 private:
  RecordingView(OrderedFrames frames, PictureChanger changer)
      : frames_(std::move(frames)), changer_(std::move(changer)) {}
  [[nodiscard]] Result<motion::Pose2> PoseAt(const Shown& shown);

  OrderedFrames frames_;
  PictureChanger changer_;
  std::optional<agent::OdometryFile> odometry_;
  std::optional<OdometrySpoiler> spoiler_;  // of the odometry
  double rate_hz_ = agent::RecordedDevice::kDefaultRate_hz;
  int width_px_ = 0;
  int recorded_frames_ = 0;
  int next_ = 0;
  // The recorded pose at the last cut, and the one that was told for it.
  motion::Pose2 recorded_since_;
  motion::Pose2 told_since_;
  motion::Pose2 told_;  // the last one
};

}  // namespace trailcast::trial
