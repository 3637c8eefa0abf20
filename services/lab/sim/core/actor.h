#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "services/lab/sim/core/world.h"
#include "services/motion/motion.h"

namespace trailcast::sim {

// A rigid piece of an actor, in the actor's frame: x ahead, z up, origin on the ground.
struct ActorPart {
  std::shared_ptr<const World> body;
  Eigen::Vector3f pivot = Eigen::Vector3f::Zero();  // the point about which it swings
  float swing_rad = 0.0F;                           // the largest swing to the front while walking
};

// An actor's shape. It is immutable, so robots may share it.
struct ActorShape {
  std::vector<ActorPart> parts;
  double stride_m = 1.4;  // two steps
};

struct ActorState {
  motion::Pose2 pose;  // world frame
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  double walked_m = 0.0;
};

// An actor's places over time, put together leg by leg. Before the first and after the last leg it
// is nowhere.
class Timetable {
 public:
  Timetable(double from_s, const motion::Pose2& at) : stops_{{from_s, at, 0.0}} {}

  // Walks straight to a place. It turns on the spot first if the place is far off its heading, and
  // takes a slight bend while walking.
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

// A person who steps in front of an approaching robot and stands in its way for a while, facing it.
// The person comes from the side with more room, and goes on past the robot on that side.
struct Encounter {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // where to stand, on the robot's path
  double ahead_m = 0.8;                             // of the robot's middle
  double stay_s = 10.0;
};

// A person or thing that moves through the world, by a timetable or towards a robot.
struct Actor {
  std::shared_ptr<const ActorShape> shape;
  std::optional<Timetable> timetable;
  std::optional<Encounter> encounter;  // gives the timetable once it happens
};

using Actors = std::vector<Actor>;

// The free room on either side of a robot that faces `heading_rad` at the encounter's place.
struct FreeRoom {
  double heading_rad = 0.0;
  double left_m = 0.0;
  double right_m = 0.0;
};
// Returns how long before standing there the person has to set out.
[[nodiscard]] double StepInDuration(const FreeRoom& room);
[[nodiscard]] Timetable TimetableOf(const Encounter& encounter, const FreeRoom& room,
                                    double from_s);

}  // namespace trailcast::sim
