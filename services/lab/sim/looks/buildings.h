#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// Builds houses and blocks. Each stands in the builder's current place: the left corner of its
// front is at the origin, the front faces -y, and the body is behind it.
class Buildings {
 public:
  enum class Wall { kBrick, kDarkBrick, kWhitePlaster, kYellowPlaster, kConcrete };

  struct Block {
    float width_m = 20.0F;
    float depth_m = 10.0F;
    int storeys = 3;
    Wall wall = Wall::kBrick;
    float window_pitch_m = 2.6F;
    bool shops = false;  // on the ground floor, instead of windows
  };
  struct House {
    float width_m = 8.0F;
    float depth_m = 8.0F;
    int storeys = 2;
    Wall wall = Wall::kWhitePlaster;
    bool alike = false;  // all windows are alike, as in a row of houses built at once
    bool garage = false;
  };

  // Keeps a reference to `builder`. The same seed gives the same curtains.
  Buildings(SceneBuilder& builder, std::uint64_t seed);

  void Stand(float x, float y, float yaw_rad, float z = 0.0F);

  void PutUp(const Block& block);  // flat roof, windows in rows on all sides
  void PutUp(const House& house);  // pitched roof, ridge along the front
  void Shed(float width, float depth);

  [[nodiscard]] MaterialId wall(Wall wall) const { return walls_[static_cast<std::size_t>(wall)]; }

 private:
  struct Opening {
    float x, z, width, height;
  };
  void Window(const Opening& at, MaterialId picture);
  void WindowRow(float width_m, float z, float pitch_m, bool alike);
  void Entrance(float x);
  void Shops(float width_m);
  void Roof(float width_m, float depth_m, float eaves_m);
  [[nodiscard]] MaterialId Any(const std::vector<MaterialId>& choice);

  SceneBuilder& b_;
  Random random_;
  std::vector<MaterialId> walls_, windows_, shops_, signs_, doors_;
  MaterialId sill_, frame_, roof_, flat_roof_, planks_, garage_, pipe_;
};

}  // namespace trailcast::sim
