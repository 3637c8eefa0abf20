#include "services/lab/sim/core/light_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/lab/sim/core/world.h"

namespace trailcast::sim {
namespace {

constexpr int kSkyRays = 20;
constexpr float kOpen_m = 1.5F;      // things further away do not darken a corner
constexpr float kLift_m = 0.012F;    // keeps samples off the surface and out of its neighbours
constexpr float kBrightest = 1.25F;  // next to a lamp

// Returns directions spread over the half-sphere about z, denser towards it (by the cosine), on a
// spiral.
std::vector<Eigen::Vector3f> HalfSphere() {
  std::vector<Eigen::Vector3f> directions;
  directions.reserve(kSkyRays);
  for (int i = 0; i < kSkyRays; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / kSkyRays;
    const float radius = std::sqrt(share);
    const float angle = 2.39996323F * static_cast<float>(i);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                            std::sqrt(1.0F - share));
  }
  return directions;
}

class Baker {
 public:
  Baker(const World& world, const std::vector<Lamp>& lamps, float ambient)
      : world_(world), lamps_(lamps), ambient_(ambient) {}

  [[nodiscard]] float LightAt(const Eigen::Vector3f& position,
                              const Eigen::Vector3f& normal) const {
    return std::min(kBrightest, FromAround(position, normal) + FromLamps(position, normal));
  }

 private:
  [[nodiscard]] float FromAround(const Eigen::Vector3f& position,
                                 const Eigen::Vector3f& normal) const {
    const Eigen::Vector3f side = normal.unitOrthogonal();
    const Eigen::Vector3f other = normal.cross(side);
    float open = 0.0F;
    for (const Eigen::Vector3f& d : directions_) {
      const Eigen::Vector3f direction = d.x() * side + d.y() * other + d.z() * normal;
      const auto hit = world_.CastRay(position, direction, kOpen_m);
      open += hit ? std::min(1.0F, static_cast<float>(hit->distance_m) / kOpen_m) : 1.0F;
    }
    return ambient_ * open / kSkyRays;
  }

  [[nodiscard]] float FromLamps(const Eigen::Vector3f& position,
                                const Eigen::Vector3f& normal) const {
    float light = 0.0F;
    for (const Lamp& lamp : lamps_) {
      const Eigen::Vector3f to_lamp = lamp.position - position;
      const float distance = to_lamp.norm();
      const Eigen::Vector3f direction = to_lamp / distance;
      const float cosines = normal.dot(direction) * -direction.dot(lamp.direction);
      if (normal.dot(direction) <= 0.0F || cosines <= 0.0F) continue;
      if (world_.CastRay(position, direction, distance - 0.05F)) continue;
      light += lamp.strength * cosines / std::max(distance * distance, 0.3F);
    }
    return light;
  }

  const World& world_;
  const std::vector<Lamp>& lamps_;
  float ambient_;
  std::vector<Eigen::Vector3f> directions_ = HalfSphere();
};

}  // namespace

Result<void> BakeLight(const std::vector<Lamp>& lamps, Scene& scene, float ambient) {
  const auto world = World::Build(scene);
  if (!world) return tl::unexpected(world.error());
  const Baker baker(**world, lamps, ambient);
  for (Mesh& mesh : scene.meshes) {
    mesh.shade.assign(mesh.positions.size(), -1.0F);
    if (scene.materials[mesh.material].glows) continue;
    for (const auto& corners : mesh.triangles) {
      const Eigen::Vector3f& a = mesh.positions[corners[0]];
      const Eigen::Vector3f& b = mesh.positions[corners[1]];
      const Eigen::Vector3f& c = mesh.positions[corners[2]];
      const Eigen::Vector3f cross = (b - a).cross(c - a);
      if (cross.norm() < 1e-9F) continue;
      const Eigen::Vector3f normal = cross.normalized();
      const Eigen::Vector3f middle = (a + b + c) / 3.0F;
      for (const std::uint32_t corner : corners) {
        if (mesh.shade[corner] >= 0.0F) continue;
        const Eigen::Vector3f& at = mesh.positions[corner];
        const Eigen::Vector3f inwards = (middle - at).normalized() * kLift_m;
        mesh.shade[corner] = baker.LightAt(at + inwards + kLift_m * normal, normal);
      }
    }
  }
  for (Mesh& mesh : scene.meshes) {
    for (float& shade : mesh.shade) shade = std::max(shade, 0.0F);
  }
  return {};
}

}  // namespace trailcast::sim
