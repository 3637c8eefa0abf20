#include "services/odometry/src/drive_track.h"

namespace trailcast::odometry {
namespace {

void AddTo(std::vector<TimedValue>& sum, double t_s, double value) {
  sum.push_back({t_s, sum.back().value + value});
}

double Change(const std::vector<TimedValue>& sum, double t_s, double period_s) {
  return ValueAt(sum, t_s) - ValueAt(sum, t_s - period_s);
}

}  // namespace

DriveTrack::DriveTrack(std::span<const DriveStep> steps) {
  const double begins_s = steps.front().t_s - steps.front().dt_s;
  for (Sum* sum : {&picture_rad_, &down_share_, &growth_, &flow_, &odometry_rad_, &driven_m_,
                   &unseen_, &broken_}) {
    sum->reserve(steps.size() + 1);
    sum->push_back({begins_s, 0.0});
  }
  for (const DriveStep& step : steps) {
    const PictureStep picture = step.picture.value_or(PictureStep{});
    AddTo(picture_rad_, step.t_s, picture.turn_rad);
    AddTo(down_share_, step.t_s, picture.down_share);
    AddTo(growth_, step.t_s, picture.growth);
    AddTo(flow_, step.t_s, picture.flow);
    AddTo(odometry_rad_, step.t_s, step.moved.heading_change_rad);
    AddTo(driven_m_, step.t_s, step.moved.distance_m);
    AddTo(unseen_, step.t_s, step.picture ? 0.0 : 1.0);
    AddTo(broken_, step.t_s, step.odometry_broke ? 1.0 : 0.0);
  }
}

DriveTrack::Window DriveTrack::Over(double t_s, double period_s, double odometry_late_s) const {
  const double told_s = t_s + odometry_late_s;
  Window window;
  window.picture_rad = Change(picture_rad_, t_s, period_s);
  window.down_share = Change(down_share_, t_s, period_s);
  window.growth = Change(growth_, t_s, period_s);
  window.flow = Change(flow_, t_s, period_s);
  window.odometry_rad = Change(odometry_rad_, told_s, period_s);
  window.driven_m = Change(driven_m_, told_s, period_s);
  window.known = std::min(t_s, told_s) - period_s >= begins_s() &&
                 std::max(t_s, told_s) <= ends_s() && Change(unseen_, t_s, period_s) <= 0.0 &&
                 Change(broken_, told_s, period_s) <= 0.0;
  return window;
}

}  // namespace trailcast::odometry
