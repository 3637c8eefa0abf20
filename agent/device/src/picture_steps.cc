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

// Where it would be if a turn shifted all of the picture alike.
route::TrackedFeature Unbent(route::TrackedFeature feature, double focal_px) {
  feature.u_px = focal_px * std::atan(feature.u_px / focal_px);
  return feature;
}

// Both in the order of their ids.
std::vector<teach::MovedFeature> InBoth(const std::vector<route::TrackedFeature>& before,
                                        const std::vector<route::TrackedFeature>& now,
                                        double focal_px) {
  std::vector<teach::MovedFeature> moved;
  std::size_t i = 0;
  for (const route::TrackedFeature& feature : now) {
    while (i < before.size() && before[i].id != feature.id) ++i;
    if (i == before.size()) break;
    moved.push_back({Unbent(before[i], focal_px), Unbent(feature, focal_px)});
  }
  return moved;
}

}  // namespace

std::optional<odometry::PictureStep> PictureSteps::Add(const image::GrayImage& frame) {
  picture_ = &intake_.Take(frame);
  const double width_px = picture_->width;
  const double focal_px = focal_share_ * width_px;
  const std::vector<route::TrackedFeature> before = tracker_.Current();
  const auto moved = InBoth(before, tracker_.Track(*picture_), focal_px);
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
