#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <array>

#include "services/lab/sim/core/stage.h"

namespace trailcast::sim {

// Sixteen rays as Embree takes them. For view_tracer.cc alone.
constexpr std::size_t kRays = 16;
// Which of them count: -1, or 0 for those that do not.
struct alignas(64) RayMask {
  std::array<int, kRays> lanes{};
  [[nodiscard]] bool any() const;
};

// All that Embree wants to know of a ray besides where it is and where it goes.
void FillDefaults(RTCRay16& rays);
[[nodiscard]] RTCIntersectContext CoherentRays();

// One of the rays, and how far the others are from it: tells quickly that none comes near a part.
struct RayBundle {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  float origins_off_m = 0.0F;
  float directions_off = 0.0F;
};
[[nodiscard]] RayBundle BundleOf(const RTCRay16& rays, const RayMask& mask);
[[nodiscard]] bool MayMeet(const RayBundle& bundle, const PlacedPart& part);

// Those of `mask` that come near the part before they end.
[[nodiscard]] RayMask PassingNear(const PlacedPart& part, const RTCRay16& rays,
                                  const RayMask& mask);
// The same rays in the part's frame.
[[nodiscard]] RTCRay16 InPartFrame(const PlacedPart& part, const RTCRay16& rays);

}  // namespace trailcast::sim
