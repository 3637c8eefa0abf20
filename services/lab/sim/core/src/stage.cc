#include "services/lab/sim/core/stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

// Feet step onto anything lower than this, such as a kerb or a mat.
constexpr double kStep_m = 0.4;
constexpr double kHipHeight_m = 0.9;
constexpr double kRoomWanted_m = 3.0;
constexpr double kFarthestStepIn_m = 3.0;

}  // namespace

void Stage::Advance(double time_s, const motion::Pose2& robot) {
  if (actors_.empty()) return;
  const double moved_m =
      robot_ ? (motion::Position(robot) - motion::Position(*robot_)).norm() : 0.0;
  const double period_s = time_s - time_s_;
  const double speed_mps = period_s > 0.0 ? moved_m / period_s : 0.0;
  robot_ = robot;
  time_s_ = time_s;
  parts_.clear();
  for (Actor& actor : actors_) {
    MeetRobot(actor, time_s, robot, speed_mps);
    const auto state = actor.timetable ? actor.timetable->At(time_s) : std::nullopt;
    if (state) PlaceParts(*actor.shape, *state);
  }
}

// The robot goes on driving while the person steps in, and meets the person at this distance.
void Stage::MeetRobot(Actor& actor, double time_s, const motion::Pose2& robot,
                      double speed_mps) const {
  if (!actor.encounter) return;
  const Encounter& encounter = *actor.encounter;
  const Eigen::Vector2d way = encounter.place - motion::Position(robot);
  if (way.norm() > encounter.ahead_m + kFarthestStepIn_m) return;
  FreeRoom room;
  room.heading_rad = std::atan2(way.y(), way.x());
  room.left_m = RoomTowards(encounter.place, room.heading_rad + Radians(90.0));
  room.right_m = RoomTowards(encounter.place, room.heading_rad - Radians(90.0));
  if (way.norm() > encounter.ahead_m + speed_mps * StepInDuration(room)) return;
  actor.timetable = TimetableOf(encounter, room, time_s);
  actor.encounter.reset();
}

double Stage::RoomTowards(const Eigen::Vector2d& from, double heading_rad) const {
  const Eigen::Vector3d origin(from.x(), from.y(), GroundUnder(from) + kHipHeight_m);
  const Eigen::Vector3d direction(std::cos(heading_rad), std::sin(heading_rad), 0.0);
  const auto hit = world_->CastRay(origin.cast<float>(), direction.cast<float>(), kRoomWanted_m);
  return hit ? hit->distance_m : kRoomWanted_m;
}

double Stage::GroundUnder(const Eigen::Vector2d& place) const {
  const double floor_m = world_->FloorHeight(place.x(), place.y()).value_or(0.0);
  const Eigen::Vector3d above(place.x(), place.y(), floor_m + kStep_m);
  const auto hit = world_->CastRay(above.cast<float>(), -Eigen::Vector3f::UnitZ(), 2.0 * kStep_m);
  return hit ? floor_m + kStep_m - hit->distance_m : floor_m;
}

void Stage::PlaceParts(const ActorShape& shape, const ActorState& state) {
  const Eigen::Vector2d at = motion::Position(state.pose);
  Eigen::Isometry3f world_from_actor = Eigen::Isometry3f::Identity();
  world_from_actor.translation() = Eigen::Vector3d(at.x(), at.y(), GroundUnder(at)).cast<float>();
  world_from_actor.rotate(
      Eigen::AngleAxisf(static_cast<float>(state.pose.heading_rad), Eigen::Vector3f::UnitZ()));
  const bool walks = state.velocity_mps.norm() > 0.1;
  const double phase = 2.0 * std::numbers::pi * state.walked_m / shape.stride_m;
  const auto sway = walks ? static_cast<float>(std::sin(phase)) : 0.0F;
  for (const ActorPart& part : shape.parts) {
    PlacedPart placed;
    placed.body = part.body.get();
    const Eigen::AngleAxisf swing(-sway * part.swing_rad, Eigen::Vector3f::UnitY());
    placed.world_from_part = world_from_actor * Eigen::Translation3f(part.pivot) * swing *
                             Eigen::Translation3f(-part.pivot);
    placed.part_from_world = placed.world_from_part.inverse();
    const auto& bounds = part.body->bounds();
    placed.middle = placed.world_from_part * bounds.center();
    placed.radius_m = 0.5F * bounds.diagonal().norm();
    placed.velocity_mps =
        Eigen::Vector3d(state.velocity_mps.x(), state.velocity_mps.y(), 0.0).cast<float>();
    const PlacedPart* last = parts_.empty() ? nullptr : &parts_.back();
    placed.first_surface = static_cast<std::uint32_t>(
        last != nullptr ? last->first_surface + last->body->surfaces().size()
                        : world_->surfaces().size());
    parts_.push_back(placed);
  }
}

std::optional<SurfaceHit> Stage::CastRay(const Eigen::Vector3f& origin,
                                         const Eigen::Vector3f& direction,
                                         double max_distance_m) const {
  std::optional<SurfaceHit> nearest;
  for (const PlacedPart& part : parts_) {
    const double reach_m = nearest ? nearest->distance_m : max_distance_m;
    if ((part.middle - origin).norm() > part.radius_m + static_cast<float>(reach_m)) continue;
    const auto hit = part.body->CastRay(part.part_from_world * origin,
                                        part.part_from_world.linear() * direction, reach_m);
    if (!hit) continue;
    nearest = SurfaceHit{hit->distance_m, part.world_from_part.linear() * hit->normal,
                         part.first_surface + hit->surface};
  }
  return nearest;
}

}  // namespace trailcast::sim
