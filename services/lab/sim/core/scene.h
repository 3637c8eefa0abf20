#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// The parts of a world as plain values, which a loader or a built-in place fills in for
// World::Build. In the world frame, x and y are level and z is up, in metres.

struct Material {
  std::string name;
  Eigen::Vector3f color = {180.0F, 180.0F, 180.0F};  // RGB 0..255; multiplies the texture / 255
  std::shared_ptr<const Texture> texture;            // null for a plain colour
  // It shines by itself (lamps, screens): it has its own brightness and takes no light.
  bool glows = false;
};

struct Mesh {
  std::size_t material = 0;
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector2f> uvs;  // one for each position, or none
  // The share of the ambient light that arrives, one for each position, or none.
  std::vector<float> shade;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Lighting {
  Eigen::Vector3f toward_sun = Eigen::Vector3f(0.45F, 0.3F, 0.84F).normalized();
  float sun = 0.75F;      // light on a surface that faces the sun; 0 for no sun and no shadows
  float ambient = 0.40F;  // light from everywhere
  // Makes surfaces that face different ways differ in ambient light too. It is off where `shade`
  // does this.
  bool ambient_by_direction = true;
  Eigen::Vector3f sky_horizon = {205.0F, 214.0F, 224.0F};
  Eigen::Vector3f sky_zenith = {120.0F, 160.0F, 215.0F};
};

enum class GroundMode {
  kMesh,  // robots stand on the surfaces of the world
  kFlat,  // robots stand on z = 0, whatever is there
};

struct Scene {
  std::string name;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  Lighting lighting;
  GroundMode ground = GroundMode::kMesh;
  // Lines for the user about things that could not be had and their replacements (a missing
  // texture).
  std::vector<std::string> warnings;
};

}  // namespace trailcast::sim
