#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <array>

#include "services/lab/sim/core/stage.h"

namespace trailcast::sim {

// These are sixteen rays as Embree takes them, for view_tracer.cc alone.
constexpr std::size_t kRays = 16;
// Marks the rays that count with -1, and the others with 0.
struct alignas(64) RayMask {
  std::array<int, kRays> lanes{};
  [[nodiscard]] bool any() const;
};

// Fills in everything that Embree needs to know of a ray except its origin and direction.
void FillDefaults(RTCRay16& rays);
[[nodiscard]] RTCIntersectContext CoherentRays();

// One of the rays and how far the others are from it, to tell quickly that none comes near a part.
struct RayBundle {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  float origins_off_m = 0.0F;
  float directions_off = 0.0F;
};
[[nodiscard]] RayBundle BundleOf(const RTCRay16& rays, const RayMask& mask);
[[nodiscard]] bool MayMeet(const RayBundle& bundle, const PlacedPart& part);

// Returns the rays of `mask` that come near the part before they end.
[[nodiscard]] RayMask PassingNear(const PlacedPart& part, const RTCRay16& rays,
                                  const RayMask& mask);
// Returns the same rays in the part's frame.
[[nodiscard]] RTCRay16 InPartFrame(const PlacedPart& part, const RTCRay16& rays);

}  // namespace trailcast::sim
