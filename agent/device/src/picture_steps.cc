#include "agent/device/src/picture_steps.h"

#include <cmath>
#include <vector>

#include "services/base/median.h"
#include "services/teach/picture_turn.h"

namespace trailcast::agent {
namespace {

constexpr double kTracked_px = 0.5;  // a feature's noise
constexpr std::size_t kFewToTell = 8;
constexpr int kFewToFollow = 30;  // of the tracker's 60

// Moves a feature to where it would be if a turn shifted the whole picture equally.
route::TrackedFeature Unbent(route::TrackedFeature feature, double focal_px) {
  feature.u_px = focal_px * std::atan(feature.u_px / focal_px);
  return feature;
}

}  // namespace

std::optional<odometry::PictureStep> PictureSteps::Add(const image::GrayImage& frame) {
  picture_ = &intake_.Take(frame);
  const double width_px = picture_->width;
  const double focal_px = focal_share_ * width_px;
  const std::vector<route::TrackedFeature> before = tracker_.Current();
  auto moved = teach::MovedBetween(before, tracker_.Track(*picture_));
  for (auto& [was, is] : moved) {
    was = Unbent(was, focal_px);
    is = Unbent(is, focal_px);
  }
  if (tracker_.count() < kFewToFollow) tracker_.Detect();
  if (moved.size() < kFewToTell) return std::nullopt;
  std::vector<double> way_px;
  way_px.reserve(moved.size());
  for (const auto& [was, is] : moved) {
    way_px.push_back(std::hypot(is.u_px - was.u_px, is.v_px - was.v_px));
  }
  const teach::PictureFlow flow = teach::FlowOf(moved, kTracked_px);
  return odometry::PictureStep{flow.u_px / focal_px, flow.v_px / width_px, flow.growth,
                               Median(std::move(way_px)) / width_px};
}

}  // namespace trailcast::agent
