#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// A level rectangle of ground.
struct GroundArea {
  Eigen::Vector2f low = {0.0F, 0.0F};
  Eigen::Vector2f high = {0.0F, 0.0F};
};

// Returns the parts of an area round a hole in it: west, east, south and north of the hole.
[[nodiscard]] std::array<GroundArea, 4> Around(const GroundArea& area, const GroundArea& hole);

// Lays ground, and paint, cracks and patches on it, in world coordinates. Layers are some
// millimetres above each other, too little for a wheel to feel.
class Paving {
 public:
  // Keeps a reference to `builder`. The same seed gives the same cracks.
  Paving(SceneBuilder& builder, std::uint64_t seed);

  // `layer` 0 is the lowest; areas that overlap need different ones.
  void AsphaltGround(const GroundArea& area, int layer = 0);
  void LawnGround(const GroundArea& area, int layer = 0);
  void SlabGround(const GroundArea& area, int layer = 0);
  // It is raised by the height of a kerb, with kerb stones round it.
  void LawnIsland(const GroundArea& area);
  void Pavement(const GroundArea& area);
  void Kerb(const Eigen::Vector2f& from, const Eigen::Vector2f& to);

  void Line(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float width_m = 0.10F);
  // Draws lines between `count` bays side by side, from `corner` along `step`, each `depth` long.
  void BayLines(const Eigen::Vector2f& corner, const Eigen::Vector2f& step,
                const Eigen::Vector2f& depth, int count);
  void Arrow(const Eigen::Vector2f& tail, float heading_rad);
  void Crack(const Eigen::Vector2f& from, const Eigen::Vector2f& to);
  void Patch(const Eigen::Vector2f& middle, const Eigen::Vector2f& size, float yaw_rad);
  void Manhole(const Eigen::Vector2f& middle);
  // Scatters cracks, patches, oil stains and manholes, as many to the square metre.
  void Wear(const GroundArea& area, float density_per_m2);
  // Adds any one of them. A long one is within `reach_m`, along or across `heading_rad`.
  void WearSpot(const Eigen::Vector2f& middle, float heading_rad, float reach_m);

  [[nodiscard]] MaterialId concrete() const { return concrete_; }
  [[nodiscard]] MaterialId asphalt() const { return asphalt_; }

 private:
  void Ground(MaterialId material, const GroundArea& area, float z_m, float tile_m);
  void Kerbs(const GroundArea& area);
  void Strip(MaterialId material, const Eigen::Vector2f& from, const Eigen::Vector2f& to,
             float width_m, float z_m, float tile_m);
  void Stain(const Eigen::Vector2f& middle, float radius_m);
  [[nodiscard]] float Between(float low, float high);

  SceneBuilder& b_;
  Random random_;
  MaterialId asphalt_, mended_, oily_, lawn_, slabs_, concrete_, paint_, tar_, manhole_;
};

}  // namespace trailcast::sim
