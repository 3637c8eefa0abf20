#include "services/lab/sim/core/actor.h"

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

constexpr double kSlightBend_rad = 0.35;
constexpr double kTurning_radps = 4.0;
// These are for a person who meets a robot: the paces, and how far to the side the person comes
// from and passes.
constexpr double kStepIn_mps = 1.6;
constexpr double kStroll_mps = 1.2;
constexpr double kAside_m = 1.1;
constexpr double kShoulder_m = 0.35;
constexpr double kLeavesBehind_m = 4.0;

double Aside(const FreeRoom& room) {
  return std::clamp(std::max(room.left_m, room.right_m) - kShoulder_m, 0.5, kAside_m);
}

}  // namespace

Timetable& Timetable::GoTo(const Eigen::Vector2d& place, double speed_mps) {
  const Eigen::Vector2d way = place - motion::Position(stops_.back().pose);
  const double length_m = way.norm();
  if (length_m < 1e-6) return *this;
  const double heading_rad = std::atan2(way.y(), way.x());
  if (std::abs(WrapAngle(heading_rad - stops_.back().pose.heading_rad)) > kSlightBend_rad) {
    TurnTo(heading_rad);
  }
  const Stop& last = stops_.back();
  stops_.push_back({last.time_s + length_m / speed_mps,
                    {place.x(), place.y(), heading_rad},
                    last.walked_m + length_m});
  return *this;
}

Timetable& Timetable::TurnTo(double heading_rad) {
  Stop turned = stops_.back();
  const double turn_rad = std::abs(WrapAngle(heading_rad - turned.pose.heading_rad));
  turned.time_s += turn_rad / kTurning_radps;
  turned.pose.heading_rad = heading_rad;
  stops_.push_back(turned);
  return *this;
}

Timetable& Timetable::Stand(double duration_s) {
  Stop stop = stops_.back();
  stop.time_s += duration_s;
  stops_.push_back(stop);
  return *this;
}

std::optional<ActorState> Timetable::At(double time_s) const {
  if (time_s < stops_.front().time_s || time_s > stops_.back().time_s) return std::nullopt;
  const auto next = std::find_if(stops_.begin() + 1, stops_.end(),
                                 [&](const Stop& stop) { return stop.time_s >= time_s; });
  if (next == stops_.end()) return ActorState{stops_.front().pose, {0.0, 0.0}, 0.0};
  const Stop& last = *(next - 1);
  const double duration_s = next->time_s - last.time_s;
  const double share = duration_s > 0.0 ? (time_s - last.time_s) / duration_s : 1.0;
  const Eigen::Vector2d way = motion::Position(next->pose) - motion::Position(last.pose);
  const Eigen::Vector2d at = motion::Position(last.pose) + share * way;
  ActorState state;
  state.pose = {
      at.x(), at.y(),
      last.pose.heading_rad + share * WrapAngle(next->pose.heading_rad - last.pose.heading_rad)};
  if (duration_s > 0.0) state.velocity_mps = way / duration_s;
  state.walked_m = last.walked_m + share * (next->walked_m - last.walked_m);
  return state;
}

double StepInDuration(const FreeRoom& room) {
  return Aside(room) / kStepIn_mps + Radians(90.0) / kTurning_radps;
}

Timetable TimetableOf(const Encounter& encounter, const FreeRoom& room, double from_s) {
  const double side = room.left_m >= room.right_m ? 1.0 : -1.0;
  const motion::Pose2 here{encounter.place.x(), encounter.place.y(), room.heading_rad};
  const auto beside = [&](double ahead_m) {
    return motion::Position(motion::Compose(here, {ahead_m, side * Aside(room), 0.0}));
  };
  Timetable table(from_s,
                  {beside(0.0).x(), beside(0.0).y(), room.heading_rad - side * Radians(90.0)});
  table.GoTo(encounter.place, kStepIn_mps)
      .TurnTo(room.heading_rad + Radians(180.0))
      .Stand(encounter.stay_s)
      .GoTo(beside(0.0), kStroll_mps)
      .GoTo(beside(-kLeavesBehind_m), kStroll_mps);
  return table;
}

}  // namespace trailcast::sim
