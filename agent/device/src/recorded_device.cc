#include "agent/device/recorded_device.h"

#include <algorithm>
#include <utility>

namespace trailcast::agent {

RecordedDevice::RecordedDevice(std::unique_ptr<image::FrameSequence> frames, image::GrayImage first,
                               std::optional<OdometryFile> odometry, double rate_hz)
    : frames_(std::move(frames)),
      width_(first.width),
      height_(first.height),
      odometry_(std::move(odometry)),
      rate_hz_(rate_hz) {
  first_ = std::move(first);
}

Result<std::unique_ptr<RecordedDevice>> RecordedDevice::Open(const RecordedRun& run) {
  auto frames = image::FrameSequence::Open(run.frames);
  if (!frames) return tl::unexpected(frames.error());
  auto first = (*frames)->Next();
  if (!first) return tl::unexpected(first.error());
  if (!first->has_value()) {
    return Fail(ErrorCode::kInvalidArgument, "{} holds no frames", run.frames.string());
  }
  std::optional<OdometryFile> odometry;
  if (!run.odometry.empty()) {
    auto read = OdometryFile::Read(run.odometry);
    if (!read) return tl::unexpected(read.error());
    odometry = std::move(*read);
  }
  const double rate_hz = run.rate_hz.value_or((*frames)->rate_hz().value_or(kDefaultRate_hz));
  return std::unique_ptr<RecordedDevice>(
      new RecordedDevice(std::move(*frames), std::move(**first), std::move(odometry), rate_hz));
}

Result<std::optional<Observation>> RecordedDevice::Next() {
  Observation observation;
  if (first_) {
    observation.image = std::move(*first_);
    first_.reset();
  } else {
    auto frame = frames_->Next();
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) return std::nullopt;
    observation.image = std::move(**frame);
  }
  observation.stamp = FromSeconds(next_ / rate_hz_);
  ++next_;
  if (odometry_) {
    auto pose = odometry_->At(observation.stamp);
    if (!pose) return tl::unexpected(pose.error());
    observation.odometry = *pose;
  }
  return observation;
}

std::string RecordedDevice::camera() const {
  return fmt::format("recorded {}x{}", width_, height_);
}

std::optional<double> RecordedDevice::drive_progress() const {
  const auto size = frames_->size();
  if (!size || *size == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(next_) / *size);
}

}  // namespace trailcast::agent
