#include "services/sim/view_tracer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace trailcast::sim {
namespace {

constexpr std::size_t kSize = RayPacket::kSize;
// Of a pixel's footprint: longer ones see coarser texture.
constexpr float kMostStretch = 2.0F * RayPacket::kMostLookups;
constexpr float kShadowOffset_m = 2e-3F;

// log2 to within 0.01: enough to choose between mip-map levels.
float FastLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float exponent = static_cast<float>(bits >> 23U) - 127.0F;
  const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U);
  return exponent + (-0.34484843F * m + 2.02466578F) * m - 1.67487759F;
}

// The texture seen through one pixel. Its footprint on the surface is as wide as the pixel's cone
// and longer by 1 / cos along the view: several lookups along it keep slanted floors sharp.
float TextureGray(const Texture& texture, const Surface& surface, const Eigen::Vector3f& direction,
                  const Eigen::Vector2f& uv, float width_m, float cosine, int most_lookups) {
  const float stretch = 1.0F / std::max(cosine, 1e-3F);
  const int lookups = std::clamp(static_cast<int>(stretch * 0.8F + 1.0F), 1, most_lookups);
  const float covered_m = width_m * std::max(1.0F, stretch / kMostStretch);
  const float level = FastLog2(std::max(covered_m * surface.texels_per_m, 1e-6F));
  if (lookups == 1) return texture.Gray(uv.x(), uv.y(), level);
  const Eigen::Vector3f along = direction - direction.dot(surface.normal) * surface.normal;
  const float length_m = width_m * std::min(stretch, kMostStretch);
  const float share = 1.0F / static_cast<float>(lookups);
  const Eigen::Vector3f step = along * (length_m * share / std::max(along.norm(), 1e-6F));
  const Eigen::Vector2f uv_step(surface.grad_u.dot(step), surface.grad_v.dot(step));
  Eigen::Vector2f at = uv - 0.5F * static_cast<float>(lookups - 1) * uv_step;
  // The lookups are shared out between the two mip-map levels instead of blending each of them.
  float lookup_level = std::max(level, 0.0F) + 0.5F * share;
  float sum = 0.0F;
  for (int i = 0; i < lookups; ++i, at += uv_step, lookup_level += share) {
    sum += texture.GrayOnLevel(at.x(), at.y(), static_cast<int>(lookup_level));
  }
  return sum * share;
}

}  // namespace

struct ViewTracer::Lit {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // towards the viewer
  float albedo = 0.0F;                               // grey level in full light
  float light = 0.0F;
  float sun = 0.0F;  // to be added to `light` unless in shadow
  bool glows = false;
};

ViewTracer::Lit ViewTracer::Shade(const Surface& surface, const RayPacket& packet, std::size_t ray,
                                  float distance, const Eigen::Vector2f& barycentric) const {
  const Eigen::Vector3f& direction = packet.directions[ray];
  const Material& material = world_.material(surface.material);
  const float facing = -direction.dot(surface.normal);
  Lit lit;
  lit.normal = facing < 0.0F ? Eigen::Vector3f(-surface.normal) : surface.normal;
  lit.albedo = GrayOf(material.color);
  lit.glows = material.glows;
  const float b = barycentric.x();
  const float c = barycentric.y();
  if (material.texture) {
    const Eigen::Vector2f uv = surface.uv + b * surface.uv_b + c * surface.uv_c;
    lit.albedo *=
        TextureGray(*material.texture, surface, direction, uv, distance * packet.spreads[ray],
                    std::abs(facing), packet.most_lookups) /
        255.0F;
  }
  const float shade =
      (1.0F - b - c) * surface.shade[0] + b * surface.shade[1] + c * surface.shade[2];
  lit.light = AmbientLight(lighting_, lit.normal) * shade;
  lit.sun = lighting_.sun * std::max(0.0F, lit.normal.dot(lighting_.toward_sun));
  return lit;
}

float ViewTracer::SkyGray(const Eigen::Vector3f& direction) const {
  const float height = std::sqrt(std::clamp(direction.z(), 0.0F, 1.0F));
  return GrayOf(lighting_.sky_horizon + height * (lighting_.sky_zenith - lighting_.sky_horizon));
}

void ViewTracer::CastShadows(const RayPacket& packet, std::array<SeenPoint, kSize>& seen,
                             std::array<Lit, kSize>& lit) const {
  alignas(32) std::array<int, kSize> valid{};
  RTCRay8 rays;
  bool any = false;
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool wanted = seen[i].surface != SeenPoint::kSky && lit[i].sun > 0.0F;
    valid[i] = wanted ? -1 : 0;
    any = any || wanted;
    const Eigen::Vector3f from =
        packet.origin + seen[i].depth_m * packet.directions[i] + kShadowOffset_m * lit[i].normal;
    rays.org_x[i] = from.x();
    rays.org_y[i] = from.y();
    rays.org_z[i] = from.z();
    rays.dir_x[i] = lighting_.toward_sun.x();
    rays.dir_y[i] = lighting_.toward_sun.y();
    rays.dir_z[i] = lighting_.toward_sun.z();
    rays.tnear[i] = 0.0F;
    rays.tfar[i] = std::numeric_limits<float>::infinity();
    rays.time[i] = 0.0F;
    rays.mask[i] = std::numeric_limits<unsigned>::max();
    rays.id[i] = 0;
    rays.flags[i] = 0;
  }
  if (!any) return;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(valid.data(), world_.embree_scene(), &context, &rays);
  for (std::size_t i = 0; i < kSize; ++i) {
    if (valid[i] == 0 || !(rays.tfar[i] < 0.0F)) continue;  // below 0 is how Embree says "hit"
    lit[i].sun = 0.0F;
    seen[i].in_shadow = true;
  }
}

std::array<SeenPoint, kSize> ViewTracer::Trace(const RayPacket& packet) const {
  alignas(32) std::array<int, kSize> valid{};
  RTCRayHit8 query;
  for (std::size_t i = 0; i < kSize; ++i) {
    valid[i] = packet.valid[i] ? -1 : 0;
    query.ray.org_x[i] = packet.origin.x();
    query.ray.org_y[i] = packet.origin.y();
    query.ray.org_z[i] = packet.origin.z();
    query.ray.dir_x[i] = packet.directions[i].x();
    query.ray.dir_y[i] = packet.directions[i].y();
    query.ray.dir_z[i] = packet.directions[i].z();
    query.ray.tnear[i] = 0.0F;
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.time[i] = 0.0F;
    query.ray.mask[i] = std::numeric_limits<unsigned>::max();
    query.ray.id[i] = 0;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), world_.embree_scene(), &context, &query);

  std::array<SeenPoint, kSize> seen;
  std::array<Lit, kSize> lit;
  for (std::size_t i = 0; i < kSize; ++i) {
    if (!packet.valid[i]) continue;
    if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
      seen[i].gray = SkyGray(packet.directions[i]);
      continue;
    }
    seen[i].surface = query.hit.primID[i];
    seen[i].depth_m = query.ray.tfar[i];
    lit[i] = Shade(world_.surfaces()[seen[i].surface], packet, i, seen[i].depth_m,
                   {query.hit.u[i], query.hit.v[i]});
  }
  if (lighting_.sun > 0.0F) CastShadows(packet, seen, lit);
  for (std::size_t i = 0; i < kSize; ++i) {
    if (seen[i].surface == SeenPoint::kSky) continue;
    // Grey levels are about the square root of light (gamma 2), in textures and in pictures.
    const float light = lit[i].glows ? 1.0F : std::sqrt(lit[i].light + lit[i].sun);
    seen[i].gray = lit[i].albedo * light;
  }
  return seen;
}

}  // namespace trailcast::sim
