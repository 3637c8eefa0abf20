#include "services/lab/sim/core/src/packet_rays.h"

#include <algorithm>
#include <limits>

namespace trailcast::sim {

bool RayMask::any() const {
  return std::any_of(lanes.begin(), lanes.end(), [](int lane) { return lane != 0; });
}

void FillDefaults(RTCRay16& rays) {
  std::fill_n(rays.tnear, kRays, 0.0F);
  std::fill_n(rays.tfar, kRays, std::numeric_limits<float>::infinity());
  std::fill_n(rays.time, kRays, 0.0F);
  std::fill_n(rays.mask, kRays, std::numeric_limits<unsigned>::max());
  std::fill_n(rays.id, kRays, 0U);
  std::fill_n(rays.flags, kRays, 0U);
}

RTCIntersectContext CoherentRays() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

RayBundle BundleOf(const RTCRay16& rays, const RayMask& mask) {
  RayBundle bundle;
  bool first = true;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (mask.lanes[i] == 0) continue;
    const Eigen::Vector3f origin(rays.org_x[i], rays.org_y[i], rays.org_z[i]);
    const Eigen::Vector3f direction(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
    if (first) {
      bundle.origin = origin;
      bundle.direction = direction;
    }
    first = false;
    bundle.origins_off_m = std::max(bundle.origins_off_m, (origin - bundle.origin).norm());
    bundle.directions_off = std::max(bundle.directions_off, (direction - bundle.direction).norm());
  }
  return bundle;
}

bool MayMeet(const RayBundle& bundle, const PlacedPart& part) {
  const Eigen::Vector3f to_middle = part.middle - bundle.origin;
  const float distance_m = to_middle.norm();
  const float reach_m =
      part.radius_m + bundle.origins_off_m + bundle.directions_off * (distance_m + part.radius_m);
  const float along_m = to_middle.dot(bundle.direction);
  return along_m > -reach_m && distance_m * distance_m - along_m * along_m < reach_m * reach_m;
}

RayMask PassingNear(const PlacedPart& part, const RTCRay16& rays, const RayMask& mask) {
  RayMask near;
  for (std::size_t i = 0; i < kRays; ++i) {
    if (mask.lanes[i] == 0) continue;
    const Eigen::Vector3f direction(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
    const Eigen::Vector3f to_middle =
        part.middle - Eigen::Vector3f(rays.org_x[i], rays.org_y[i], rays.org_z[i]);
    const float along = to_middle.dot(direction);
    const float off = to_middle.squaredNorm() - along * along;
    const bool passes = off < part.radius_m * part.radius_m && along > -part.radius_m &&
                        along - part.radius_m < rays.tfar[i];
    near.lanes[i] = passes ? -1 : 0;
  }
  return near;
}

RTCRay16 InPartFrame(const PlacedPart& part, const RTCRay16& rays) {
  RTCRay16 turned = rays;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Eigen::Vector3f origin =
        part.part_from_world * Eigen::Vector3f(rays.org_x[i], rays.org_y[i], rays.org_z[i]);
    const Eigen::Vector3f direction = part.part_from_world.linear() *
                                      Eigen::Vector3f(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
    turned.org_x[i] = origin.x();
    turned.org_y[i] = origin.y();
    turned.org_z[i] = origin.z();
    turned.dir_x[i] = direction.x();
    turned.dir_y[i] = direction.y();
    turned.dir_z[i] = direction.z();
  }
  return turned;
}

}  // namespace trailcast::sim
