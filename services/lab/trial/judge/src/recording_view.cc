#include "services/lab/trial/judge/src/recording_view.h"

#include <utility>

#include "services/lab/trial/recording/frame_order.h"
#include "services/vision/picture_intake.h"

namespace trailcast::trial {

Result<RecordingView> RecordingView::Open(const agent::RecordedRun& run,
                                          const Disturbance& disturbance,
                                          const OdometryNoise& noise, std::uint64_t seed) {
  // This also finds unusable recordings, as an agent does.
  const auto device = agent::RecordedDevice::Open(run);
  if (!device) return tl::unexpected(device.error());
  const auto count = CountFrames(run.frames);
  if (!count) return tl::unexpected(count.error());
  auto order = OrderOf(disturbance, *count, seed);
  if (!order) return Wrap(order.error(), run.frames.string());
  auto frames = OrderedFrames::Open(run.frames, std::move(*order), vision::kEnoughPx);
  if (!frames) return tl::unexpected(frames.error());
  RecordingView view(std::move(*frames), PictureChanger(disturbance, seed));
  view.rate_hz_ = (*device)->rate_hz();
  view.recorded_frames_ = *count;
  view.width_px_ = (*device)->width_px();
  if (!run.odometry.empty()) {
    auto odometry = agent::OdometryFile::Read(run.odometry);
    if (!odometry) return tl::unexpected(odometry.error());
    view.odometry_ = std::move(*odometry);
    view.spoiler_.emplace(noise, static_cast<double>(view.order().size()) / view.rate_hz_, seed);
  }
  return view;
}

Result<std::optional<agent::Observation>> RecordingView::Next() {
  auto frame = frames_.Next();
  if (!frame) return tl::unexpected(frame.error());
  if (!*frame) return std::nullopt;
  auto picture = changer_.Apply(std::move(**frame), next_);
  if (!picture) return tl::unexpected(picture.error());
  agent::Observation seen;
  seen.image = std::move(*picture);
  seen.stamp = FromSeconds(next_ / rate_hz_);
  if (odometry_) {
    auto pose = PoseAt(order()[static_cast<std::size_t>(next_)]);
    if (!pose) return tl::unexpected(pose.error());
    seen.odometry = spoiler_->Tell(seen.stamp, *pose);
  }
  ++next_;
  return seen;
}

Result<motion::Pose2> RecordingView::PoseAt(const Shown& shown) {
  const auto recorded = odometry_->At(FromSeconds(shown.frame / rate_hz_));
  if (!recorded) return tl::unexpected(recorded.error());
  if (next_ == 0) recorded_since_ = told_since_ = *recorded;
  if (shown.cut) {
    recorded_since_ = *recorded;
    told_since_ = told_;
  }
  told_ = motion::Compose(told_since_, motion::Between(recorded_since_, *recorded));
  return told_;
}

}  // namespace trailcast::trial
