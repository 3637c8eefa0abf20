#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/scene.h"

struct RTCSceneTy;

namespace trailcast::sim {

// One triangle with precomputed values for shading.
struct Surface {
  Eigen::Vector3f normal;          // unit; either side may be seen
  Eigen::Vector2f uv, uv_b, uv_c;  // at the first corner; then the second's and the third's
                                   // difference to it
  Eigen::Vector3f grad_u, grad_v;  // change of u and v for a step along the surface, 1/m
  float texels_per_m = 0.0F;
  float shade[3] = {1.0F, 1.0F, 1.0F};
  std::uint32_t material = 0;
};

// The properties of a material that shading needs. They are few bytes, because every ray looks at
// them.
struct Paint {
  const Texture* texture = nullptr;  // null for a plain colour
  float gray = 0.0F;                 // of a plain colour; with a texture, a factor for its grey
  bool glows = false;
};

struct SurfaceHit {
  double distance_m = 0.0;
  Eigen::Vector3f normal;
  std::uint32_t surface = 0;
};

// A place to drive through and look at. It is immutable after Build, so any number of robots and
// threads may share it.
class World {
 public:
  // Fails with kInvalidArgument if the scene has no triangle of any area.
  [[nodiscard]] static Result<std::shared_ptr<const World>> Build(Scene scene);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  [[nodiscard]] const std::string& name() const { return scene_.name; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return scene_.warnings; }
  [[nodiscard]] const Lighting& lighting() const { return scene_.lighting; }
  [[nodiscard]] GroundMode ground() const { return scene_.ground; }
  [[nodiscard]] const Eigen::AlignedBox3f& bounds() const { return bounds_; }

  // Returns the height of the highest surface below `z_max_m` at a place (0 on flat ground), or
  // nothing if there is none.
  [[nodiscard]] std::optional<double> GroundHeight(double x_m, double y_m, double z_max_m) const;
  // Returns the height at which a robot would stand: the lowest surface with half a metre of free
  // space above it, which is neither the earth below the floor nor the roof.
  [[nodiscard]] std::optional<double> FloorHeight(double x_m, double y_m) const;
  // Returns the first surface along a ray; `direction` is a unit vector.
  [[nodiscard]] std::optional<SurfaceHit> CastRay(const Eigen::Vector3f& origin,
                                                  const Eigen::Vector3f& direction,
                                                  double max_distance_m) const;

  // For renderers: Embree's scene has one geometry, whose primitive ids are indices into
  // surfaces().
  [[nodiscard]] RTCSceneTy* embree_scene() const { return embree_scene_; }
  [[nodiscard]] const std::vector<Surface>& surfaces() const { return surfaces_; }
  [[nodiscard]] const Paint& paint(std::uint32_t material) const { return paints_[material]; }
  // Returns the texture coordinates of a point on a surface.
  [[nodiscard]] Eigen::Vector2f TextureAt(std::uint32_t surface, const Eigen::Vector3f& at) const;
  [[nodiscard]] const Material& material(std::uint32_t index) const {
    return scene_.materials[index];
  }

 private:
  World() = default;
  [[nodiscard]] std::optional<double> SurfaceBelow(double x_m, double y_m, double z_max_m) const;
  void AddSurface(const Mesh& mesh, const std::array<std::uint32_t, 3>& corners);
  Result<void> BuildEmbreeScene();

  Scene scene_;  // its meshes are moved into the arrays below
  Eigen::AlignedBox3f bounds_;
  std::vector<Eigen::Vector3f> corners_;  // three a triangle
  std::vector<Surface> surfaces_;
  std::vector<Paint> paints_;  // one a material
  RTCSceneTy* embree_scene_ = nullptr;
};

[[nodiscard]] inline float GrayOf(const Eigen::Vector3f& rgb) {
  return 0.299F * rgb.x() + 0.587F * rgb.y() + 0.114F * rgb.z();
}

}  // namespace trailcast::sim
