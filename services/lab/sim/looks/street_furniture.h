#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// Builds lamp posts, signs, bins, fences and walls. Single pieces stand in the builder's current
// place, with their foot at the origin and the front towards -y. Fences and walls run from the
// origin along x.
class StreetFurniture {
 public:
  // Keeps a reference to `builder`. The same seed gives the same leaning posts.
  StreetFurniture(SceneBuilder& builder, std::uint64_t seed);

  void Stand(float x, float y, float yaw_rad = 0.0F, float z = 0.0F);
  // Puts the origin at `from` with x towards `to`, and returns the distance.
  float StandAlong(const Eigen::Vector2f& from, const Eigen::Vector2f& to);

  void LampPost(float height_m = 5.0F);
  void ParkingSign();
  void SpeedSign();
  void Bollard();
  void Bench();
  void LitterBin();
  void Bicycle();
  void PicketFence(float length_m, float height_m = 1.1F);
  void BoardFence(float length_m, float height_m = 1.8F);
  void RailFence(float length_m, float height_m = 1.2F);  // posts and three rails
  void Railing(float length_m, float height_m = 1.0F);    // metal, upright bars
  void GardenWall(float length_m, float height_m = 0.9F);

 private:
  void Sign(MaterialId face, float width_m, float height_m);

  SceneBuilder& b_;
  Random random_;
  MaterialId steel_, lamp_, black_, white_wood_, weathered_, boards_, brick_, coping_, green_;
  MaterialId parking_sign_, round_sign_, poster_, timber_;
};

}  // namespace trailcast::sim
