#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "services/lab/sim/core/world.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

// A piece of an actor that does not bend. Frame: the actor's, x ahead, z up, origin on the ground.
struct ActorPart {
  std::shared_ptr<const World> body;
  Eigen::Vector3f pivot = Eigen::Vector3f::Zero();  // about which it swings
  float swing_rad = 0.0F;                           // to the front at most, when walking
};

// What an actor looks like. Immutable, so that robots may share it.
struct ActorShape {
  std::vector<ActorPart> parts;
  double stride_m = 1.4;  // two steps
};

struct ActorState {
  motion::Pose2 pose;  // world frame
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  double walked_m = 0.0;
};

// Where an actor is at what time: put together leg by leg. Before the first and after the last it
// is nowhere.
class Timetable {
 public:
  Timetable(double from_s, const motion::Pose2& at) : stops_{{from_s, at, 0.0}} {}

  // Straight there. Turns on the spot first if that is far from where it looks; a slight bend is
  // taken on the way.
  Timetable& GoTo(const Eigen::Vector2d& place, double speed_mps);
  Timetable& TurnTo(double heading_rad);
  Timetable& Stand(double duration_s);

  [[nodiscard]] std::optional<ActorState> At(double time_s) const;
  [[nodiscard]] double until_s() const { return stops_.back().time_s; }

 private:
  struct Stop {
    double time_s;
    motion::Pose2 pose;
    double walked_m;
  };
  std::vector<Stop> stops_;  // at rising times
};

// Somebody who steps in front of a robot that comes along, and stands in its way for a while,
// facing it: comes from the side with more room, and goes on past the robot on that side.
struct Encounter {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // where to stand, on the robot's path
  double ahead_m = 0.8;                             // of the robot's middle, once there
  double stay_s = 10.0;
};

// Somebody or something that moves through the world, by a timetable or up to a robot.
struct Actor {
  std::shared_ptr<const ActorShape> shape;
  std::optional<Timetable> timetable;
  std::optional<Encounter> encounter;  // gives the timetable when it happens
};

using Actors = std::vector<Actor>;

// Free room to either side of a robot that faces `heading_rad` at the encounter's place.
struct FreeRoom {
  double heading_rad = 0.0;
  double left_m = 0.0;
  double right_m = 0.0;
};
// How long before standing there the person has to set out.
[[nodiscard]] double StepInDuration(const FreeRoom& room);
[[nodiscard]] Timetable TimetableOf(const Encounter& encounter, const FreeRoom& room,
                                    double from_s);

}  // namespace trailcast::sim
