#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "services/sim/world.h"

namespace trailcast::sim {

// Eight rays from one place, traced together.
struct RayPacket {
  static constexpr std::size_t kSize = 8;
  Eigen::Vector3f origin;
  std::array<Eigen::Vector3f, kSize> directions;  // unit vectors
  // Angle that the ray's pixel covers, radians: what textures are averaged over.
  std::array<float, kSize> spreads{};
  std::array<bool, kSize> valid{};
  // Of a texture along the long side of a slanted pixel's footprint; fewer where several rays share
  // a pixel.
  static constexpr int kMostLookups = 6;
  int most_lookups = kMostLookups;
};

// What one ray sees.
struct SeenPoint {
  static constexpr std::uint32_t kSky = 0xFFFFFFFFU;
  float gray = 0.0F;     // 0..255 and above where it is brighter than white
  float depth_m = 1e9F;  // along the ray
  std::uint32_t surface = kSky;
  bool in_shadow = false;
};

// Rays into a world, and what they see: texture filtered over the pixel's footprint, ambient light,
// sun with its shadows. Keeps a reference to the world.
class ViewTracer {
 public:
  ViewTracer(const World& world, const Lighting& lighting) : world_(world), lighting_(lighting) {}

  [[nodiscard]] std::array<SeenPoint, RayPacket::kSize> Trace(const RayPacket& packet) const;

 private:
  struct Lit;  // a surface point between the primary ray and its shadow ray
  [[nodiscard]] Lit Shade(const Surface& surface, const RayPacket& packet, std::size_t ray,
                          float distance, const Eigen::Vector2f& barycentric) const;
  [[nodiscard]] float SkyGray(const Eigen::Vector3f& direction) const;
  void CastShadows(const RayPacket& packet, std::array<SeenPoint, RayPacket::kSize>& seen,
                   std::array<Lit, RayPacket::kSize>& lit) const;

  const World& world_;
  Lighting lighting_;
};

// Ambient light on a surface whose normal (towards the viewer) is `normal`: more from above, and
// a little from one side, so that walls, floor and ceiling of one colour can be told apart.
[[nodiscard]] inline float AmbientLight(const Lighting& lighting, const Eigen::Vector3f& normal) {
  if (!lighting.ambient_by_direction) return lighting.ambient;
  return lighting.ambient * (0.80F + 0.14F * normal.z() + 0.09F * normal.x() + 0.05F * normal.y());
}

[[nodiscard]] inline float GrayOf(const Eigen::Vector3f& rgb) {
  return 0.299F * rgb.x() + 0.587F * rgb.y() + 0.114F * rgb.z();
}

}  // namespace trailcast::sim
