#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "services/lab/sim/core/actor.h"

namespace trailcast::sim {

// A part of an actor at its present place, for renderers and bumpers.
struct PlacedPart {
  const World* body = nullptr;
  Eigen::Isometry3f world_from_part;
  Eigen::Isometry3f part_from_world;
  // A bounding ball in the world, which most rays miss.
  Eigen::Vector3f middle;
  float radius_m = 0.0F;
  Eigen::Vector3f velocity_mps;
  // The number of its first surface, counted on from the world's.
  std::uint32_t first_surface = 0;
};

// The present places of all actors by one robot's clock. The world itself does not change, and many
// robots can share it. Without actors this costs nothing.
class Stage {
 public:
  Stage(std::shared_ptr<const World> world, Actors actors)
      : world_(std::move(world)), actors_(std::move(actors)) {}

  // Moves all actors to their places at that time, where a robot stands at `robot`.
  void Advance(double time_s, const motion::Pose2& robot);

  [[nodiscard]] const std::vector<PlacedPart>& parts() const { return parts_; }
  // Returns the first actor's surface along a ray; its number counts on from the world's.
  [[nodiscard]] std::optional<SurfaceHit> CastRay(const Eigen::Vector3f& origin,
                                                  const Eigen::Vector3f& direction,
                                                  double max_distance_m) const;

 private:
  void MeetRobot(Actor& actor, double time_s, const motion::Pose2& robot, double speed_mps) const;
  [[nodiscard]] double RoomTowards(const Eigen::Vector2d& from, double heading_rad) const;
  [[nodiscard]] double GroundUnder(const Eigen::Vector2d& place) const;
  void PlaceParts(const ActorShape& shape, const ActorState& state);

  std::shared_ptr<const World> world_;
  Actors actors_;
  std::vector<PlacedPart> parts_;
  double time_s_ = 0.0;
  std::optional<motion::Pose2> robot_;  // at that time
};

}  // namespace trailcast::sim
