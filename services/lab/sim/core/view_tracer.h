#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "services/lab/sim/core/stage.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::sim {

// Sixteen rays from one place, traced together. They are cheaper the closer they are.
struct RayPacket {
  static constexpr std::size_t kSize = 16;
  template <typename T>
  using Lanes = std::array<T, kSize>;

  Eigen::Vector3f origin;
  Lanes<float> x{}, y{}, z{};  // unit vectors
  // The angle that the ray's pixel covers, in radians, over which textures are averaged. 0 marks a
  // missing ray.
  Lanes<float> spreads{};
  // Lookups of a texture along the long side of a slanted pixel's footprint. They are fewer if
  // several rays share a pixel.
  static constexpr int kMostLookups = 6;
  int most_lookups = kMostLookups;

  [[nodiscard]] Eigen::Vector3f Direction(std::size_t ray) const {
    return {x[ray], y[ray], z[ray]};
  }
  void SetRay(std::size_t ray, const Eigen::Vector3f& direction, float spread) {
    x[ray] = direction.x();
    y[ray] = direction.y();
    z[ray] = direction.z();
    spreads[ray] = spread;
  }
};

// The first thing that each ray of a packet meets.
struct PacketHits {
  static constexpr std::uint32_t kSky = 0xFFFFFFFFU;
  static constexpr float kSkyDepth_m = 1e9F;
  RayPacket::Lanes<std::uint32_t> surface{};
  RayPacket::Lanes<float> depth_m{};  // along the ray
  RayPacket::Lanes<float> b{}, c{};   // barycentric: share of the surface's 2nd and 3rd corner

  void CopyFrom(const PacketHits& other, std::size_t from, std::size_t to) {
    surface[to] = other.surface[from];
    depth_m[to] = other.depth_m[from];
    b[to] = other.b[from];
    c[to] = other.c[from];
  }
};

// The appearance of these.
struct PacketView {
  RayPacket::Lanes<float> gray{};  // 0..255, and more if it is brighter than white
  RayPacket::Lanes<bool> in_shadow{};
};

// Casts rays into a world and tells what they see: texture filtered over the pixel's footprint,
// ambient light, and sun with its shadows. It keeps a reference to the world. Actors' surfaces are
// counted on from the world's.
class ViewTracer {
 public:
  ViewTracer(const World& world, const Lighting& lighting) : world_(world), lighting_(lighting) {}

  // Sets the actors that are there until the next call; `parts` is not copied.
  void ShowActors(std::span<const PlacedPart> parts) { actors_ = parts; }

  [[nodiscard]] PacketHits FindHits(const RayPacket& packet) const;
  [[nodiscard]] PacketView Shade(const RayPacket& packet, const PacketHits& hits) const;
  // Returns the actor's part that a surface belongs to, or null if it is the world's own.
  [[nodiscard]] const PlacedPart* PartOf(std::uint32_t surface) const;

 private:
  struct Lit;  // surface points, before it is known which of them the sun reaches
  void ShadeSurface(const RayPacket& packet, const PacketHits& hits, std::size_t ray,
                    Lit& lit) const;
  [[nodiscard]] float SkyGray(float direction_z) const;
  void CastShadows(const RayPacket& packet, const PacketHits& hits, Lit& lit,
                   RayPacket::Lanes<bool>& in_shadow) const;

  const World& world_;
  std::span<const PlacedPart> actors_;
  Lighting lighting_;
};

// Returns the ambient light on a surface whose normal (towards the viewer) is `normal`: more from
// above and a little from one side, so that walls, floor and ceiling of one colour can be told
// apart.
[[nodiscard]] inline float AmbientLight(const Lighting& lighting, const Eigen::Vector3f& normal) {
  if (!lighting.ambient_by_direction) return lighting.ambient;
  return lighting.ambient * (0.80F + 0.14F * normal.z() + 0.09F * normal.x() + 0.05F * normal.y());
}

}  // namespace trailcast::sim
