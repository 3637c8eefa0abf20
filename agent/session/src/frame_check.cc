#include "agent/session/frame_check.h"

#include <algorithm>

namespace trailcast::agent {
namespace {

constexpr int kSmallest_px = 8;  // a feature's surroundings have more

}  // namespace

Result<void> FrameCheck::Check(const Observation& observation) {
  const image::GrayImage& image = observation.image;
  const bool odometry = observation.odometry.has_value();
  if (image.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "the camera gave an empty frame at {:.3f} s",
                Seconds(observation.stamp));
  }
  if (std::min(image.width, image.height) < kSmallest_px) {
    return Fail(ErrorCode::kInvalidArgument,
                "the camera's pictures are {}x{} pixels, in which nothing can be seen: expected at "
                "least {} each way, and better 160x120 or more",
                image.width, image.height, kSmallest_px);
  }
  if (!first_) {
    first_ = {image.width, image.height, odometry};
    return {};
  }
  if (image.width != first_->width || image.height != first_->height) {
    return Fail(ErrorCode::kInvalidArgument,
                "the frame at {:.3f} s is {}x{} pixels, those before were {}x{}: a camera must not "
                "change its picture size midway",
                Seconds(observation.stamp), image.width, image.height, first_->width,
                first_->height);
  }
  if (odometry != first_->odometry) {
    return Fail(ErrorCode::kUnavailable, "odometry {} at {:.3f} s, midway through the run",
                odometry ? "appeared" : "stopped", Seconds(observation.stamp));
  }
  return {};
}

}  // namespace trailcast::agent
