#include "agent/device/recorded_device.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "agent/device/src/recorded/time_in.h"
#include "services/base/number_table.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

RecordedDevice::RecordedDevice(std::unique_ptr<image::FrameSequence> frames, image::GrayImage first,
                               std::optional<OdometryFile> odometry, double rate_hz)
    : frames_(std::move(frames)),
      width_(frames_->reduced() * first.width),
      height_(frames_->reduced() * first.height),
      odometry_(std::move(odometry)),
      rate_hz_(rate_hz) {
  first_ = std::move(first);
  frame_ = frames_->number();
  TellNews();
}

Result<void> RecordedDevice::ReadFrameTimes(const std::filesystem::path& file) {
  times_file_ = file;
  const auto rows = ReadNumbers(file, {"t_s"});
  if (!rows) return tl::unexpected(rows.error());
  if (auto paced = CheckPace(*rows, file); !paced) return paced;
  for (const NumberRow& row : *rows) {
    const auto time = TimeIn(row, file);
    if (!time) return tl::unexpected(time.error());
    if (!times_.empty() && *time <= times_.back()) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{}, line {}: time {} s does not come after the line before", file.string(),
                  row.line, row.cells[0]);
    }
    times_.push_back(*time);
  }
  const auto frames = frames_->size();
  if (times_.empty() || (frames && static_cast<std::size_t>(*frames) > times_.size())) {
    return Fail(ErrorCode::kInvalidArgument, "{} has {} times for {} frames: expected one each",
                file.string(), times_.size(), frames.value_or(0));
  }
  return {};
}

Result<std::unique_ptr<RecordedDevice>> RecordedDevice::Open(const RecordedRun& run) {
  const std::string ending = run.frames.extension().string();
  if (ending == ".db3" || ending == ".mcap") {
    return Fail(ErrorCode::kInvalidArgument,
                "{} is a recording of topics: give it with --bag instead of --frames",
                run.frames.string());
  }
  auto frames = image::FrameSequence::Open(run.frames, vision::kEnoughPx);
  if (!frames) return tl::unexpected(frames.error());
  auto first = (*frames)->Next();
  if (!first) return tl::unexpected(first.error());
  if (!first->has_value()) {
    return Fail(ErrorCode::kInvalidArgument, "{} holds no frames{}{}", run.frames.string(),
                (*frames)->number() < 0 ? "" : ": ", fmt::join((*frames)->TakeNews(), "; "));
  }
  std::optional<OdometryFile> odometry;
  if (!run.odometry.empty()) {
    auto read = OdometryFile::Read(run.odometry);
    if (!read) return tl::unexpected(read.error());
    odometry = std::move(*read);
  }
  const double rate_hz = run.rate_hz.value_or((*frames)->rate_hz().value_or(kDefaultRate_hz));
  std::unique_ptr<RecordedDevice> device(
      new RecordedDevice(std::move(*frames), std::move(**first), std::move(odometry), rate_hz));
  if (!run.frame_times.empty()) {
    if (auto read = device->ReadFrameTimes(run.frame_times); !read) {
      return tl::unexpected(read.error());
    }
  }
  return device;
}

Result<SensorTime> RecordedDevice::StampOfFrame() const {
  if (times_.empty()) return FromSeconds(frame_ / rate_hz_);
  const auto at = static_cast<std::size_t>(frame_);
  if (at < times_.size()) return times_[at];
  return Fail(ErrorCode::kInvalidArgument, "{} has {} times, but there are more frames",
              times_file_.string(), times_.size());
}

void RecordedDevice::TellNews() {
  for (const std::string& each : frames_->TakeNews()) spdlog::warn("{}", each);
}

Result<std::optional<Observation>> RecordedDevice::Next() {
  Observation observation;
  if (first_) {
    observation.image = std::move(*first_);
    first_.reset();
  } else {
    auto frame = frames_->Next();
    TellNews();
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) return std::nullopt;
    frame_ = frames_->number();
    observation.image = std::move(**frame);
  }
  const auto stamp = StampOfFrame();
  if (!stamp) return tl::unexpected(stamp.error());
  observation.stamp = *stamp;
  if (odometry_) {
    auto pose = odometry_->At(observation.stamp);
    if (!pose) return tl::unexpected(pose.error());
    observation.odometry = *pose;
    std::vector<std::string> news;
    observation.unknown = odometry_->TakeUnknown(observation.stamp, news);
    for (const std::string& each : news)
      spdlog::warn("at {:.2f} s {}", Seconds(observation.stamp), each);
  }
  return observation;
}

std::string RecordedDevice::camera() const {
  return fmt::format("recorded {}x{}", width_, height_);
}

std::string RecordedDevice::timing() const {
  if (!times_.empty()) return "frames by their own times";
  return fmt::format("{:g} frames a second", rate_hz_);
}

std::optional<double> RecordedDevice::drive_progress() const {
  const auto size = frames_->size();
  if (!size || *size == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(frame_ + 1) / *size);
}

}  // namespace trailcast::agent
