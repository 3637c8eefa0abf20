#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "services/lab/sim/core/scene.h"

namespace trailcast::sim {

// Names a material of the scene being built.
struct MaterialId {
  std::size_t index = 0;
};

// Part of a texture: u to the right, v down.
struct TexturePart {
  Eigen::Vector2f upper_left = {0.0F, 0.0F};
  Eigen::Vector2f lower_right = {1.0F, 1.0F};
};

// Builds a scene from boxes, cylinders and panels, each in the frame of `Place`. Furniture is
// described once (x to its right, y to its back, z up, front at y = 0) and put where it stands.
class SceneBuilder {
 public:
  // This is fine enough for soft shadows under desks, and coarse enough to bake quickly.
  static constexpr float kBakedCell_m = 0.3F;

  // Panels are cut into cells of at most that size, to whose corners light is baked.
  explicit SceneBuilder(float cell_m = kBakedCell_m) : cell_m_(cell_m) {}

  MaterialId AddMaterial(const std::string& name, const Eigen::Vector3f& color,
                         std::shared_ptr<const Texture> texture = nullptr, bool glows = false);

  // Sets the frame of everything that follows: its origin in the world, turned by `yaw_rad`.
  void Place(const Eigen::Vector3f& origin, float yaw_rad);
  // Sets the frame within another place's.
  void PlaceIn(const Eigen::Isometry3f& frame, const Eigen::Vector3f& origin, float yaw_rad);
  [[nodiscard]] const Eigen::Isometry3f& place() const { return place_; }

  // Adds a rectangle from its upper left corner (seen from its front) to the right and down, cut
  // into cells.
  void Panel(MaterialId material, const Eigen::Vector3f& upper_left, const Eigen::Vector3f& right,
             const Eigen::Vector3f& down, const TexturePart& part = {});
  // Adds a box, on each of whose faces the texture repeats every `tile_m` metres.
  void Box(MaterialId material, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
           float tile_m = 1.0F);
  // Adds an upright cylinder with a lid; the texture goes round it `repeats` times.
  void Cylinder(MaterialId material, const Eigen::Vector3f& foot, float radius_m, float height_m,
                float repeats = 1.0F, int sides = 14);
  // Adds a bar of square section between two points.
  void Bar(MaterialId material, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
           float thickness_m);
  // Adds any four corners: upper left, lower left, lower right, upper right. They are not cut into
  // cells.
  void Quad(MaterialId material, const std::array<Eigen::Vector3f, 4>& corners,
            const TexturePart& part = {});
  // Adds an open tube or cone; the texture goes round it once and repeats along it every `tile_m`.
  void Tube(MaterialId material, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
            float radius_from_m, float radius_to_m, int sides, float tile_m = 1.0F);
  // Adds a flat disc that looks along `axis`, with the texture's inscribed circle on it.
  void Disc(MaterialId material, const Eigen::Vector3f& middle, const Eigen::Vector3f& axis,
            float radius_m, int sides);
  // Adds any piece, with texture coordinates; its own material is ignored.
  void Add(MaterialId material, const Mesh& piece);

  [[nodiscard]] Scene Take(const std::string& name);

 private:
  Mesh& MeshOf(MaterialId material);
  void Facing(MaterialId material, const Eigen::Vector3f& upper_left, const Eigen::Vector3f& right,
              const Eigen::Vector3f& down, float tile_m);

  float cell_m_;
  Scene scene_;
  Eigen::Isometry3f place_ = Eigen::Isometry3f::Identity();
};

}  // namespace trailcast::sim
