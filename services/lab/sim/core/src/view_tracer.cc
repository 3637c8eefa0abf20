#include "services/lab/sim/core/view_tracer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "services/lab/sim/core/src/packet_rays.h"

namespace trailcast::sim {
namespace {

constexpr std::size_t kSize = RayPacket::kSize;
static_assert(kSize == kRays);
// The most that a pixel's footprint is stretched; longer ones use a coarser texture.
constexpr float kMostStretch = 2.0F * RayPacket::kMostLookups;
constexpr float kShadowOffset_m = 2e-3F;

// Returns log2 to within 0.01, which is enough to choose between mip-map levels.
float FastLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float exponent = static_cast<float>(bits >> 23U) - 127.0F;
  const float m = std::bit_cast<float>((bits & 0x007FFFFFU) | 0x3F800000U);
  return exponent + (-0.34484843F * m + 2.02466578F) * m - 1.67487759F;
}

// Returns the texture seen through one pixel. The pixel's footprint on the surface is as wide as
// the pixel's cone, and longer by 1 / cos along the view. Several lookups along it keep slanted
// floors sharp.
float TextureGray(const Texture& texture, const Surface& surface, const Eigen::Vector3f& direction,
                  const Eigen::Vector2f& uv, float width_m, float cosine, int most_lookups) {
  const float stretch = 1.0F / std::max(cosine, 1e-3F);
  const int lookups = std::clamp(static_cast<int>(stretch * 0.8F + 1.0F), 1, most_lookups);
  const float covered_m = width_m * std::max(1.0F, stretch / kMostStretch);
  const float level = FastLog2(std::max(covered_m * surface.texels_per_m, 1e-6F));
  if (lookups == 1) return texture.Gray(uv.x(), uv.y(), level);
  const Eigen::Vector3f along = direction - direction.dot(surface.normal) * surface.normal;
  const float length_m = width_m * std::min(stretch, kMostStretch);
  const float step_m = length_m / static_cast<float>(lookups);
  const Eigen::Vector3f step = along * (step_m / std::max(along.norm(), 1e-6F));
  const Eigen::Vector2f uv_step(surface.grad_u.dot(step), surface.grad_v.dot(step));
  return texture.GrayAlong(uv, uv_step, lookups, level);
}

// Replaces the hits of rays that meet the part sooner.
void FindOnPart(const PlacedPart& part, const RTCRayHit16& query, const RayMask& mask,
                PacketHits& hits) {
  RTCRayHit16 own = query;
  std::copy_n(hits.depth_m.begin(), kSize, own.ray.tfar);
  const RayMask near = PassingNear(part, own.ray, mask);
  if (!near.any()) return;
  own.ray = InPartFrame(part, own.ray);
  std::fill_n(own.hit.geomID, kSize, RTC_INVALID_GEOMETRY_ID);
  RTCIntersectContext context = CoherentRays();
  rtcIntersect16(near.lanes.data(), part.body->embree_scene(), &context, &own);
  for (std::size_t i = 0; i < kSize; ++i) {
    if (near.lanes[i] == 0 || own.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits.surface[i] = part.first_surface + own.hit.primID[i];
    hits.depth_m[i] = own.ray.tfar[i];
    hits.b[i] = own.hit.u[i];
    hits.c[i] = own.hit.v[i];
  }
}

// Marks the rays that the part blocks as Embree does, by an end below 0.
void ShadowOfPart(const PlacedPart& part, const RayMask& mask, RTCRay16& rays) {
  const RayMask near = PassingNear(part, rays, mask);
  if (!near.any()) return;
  RTCRay16 own = InPartFrame(part, rays);
  RTCIntersectContext context = CoherentRays();
  rtcOccluded16(near.lanes.data(), part.body->embree_scene(), &context, &own);
  std::copy_n(own.tfar, kSize, rays.tfar);
}

}  // namespace

struct ViewTracer::Lit {
  RayPacket::Lanes<Eigen::Vector3f> normal;  // towards the viewer
  RayPacket::Lanes<float> albedo{};          // grey level in full light
  RayPacket::Lanes<float> light{};
  RayPacket::Lanes<float> sun{};  // to be added to `light` unless in shadow
};

PacketHits ViewTracer::FindHits(const RayPacket& packet) const {
  RayMask valid;
  RTCRayHit16 query;
  FillDefaults(query.ray);
  std::fill_n(query.ray.org_x, kSize, packet.origin.x());
  std::fill_n(query.ray.org_y, kSize, packet.origin.y());
  std::fill_n(query.ray.org_z, kSize, packet.origin.z());
  std::copy_n(packet.x.begin(), kSize, query.ray.dir_x);
  std::copy_n(packet.y.begin(), kSize, query.ray.dir_y);
  std::copy_n(packet.z.begin(), kSize, query.ray.dir_z);
  std::fill_n(query.hit.geomID, kSize, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], kSize, RTC_INVALID_GEOMETRY_ID);
  for (std::size_t i = 0; i < kSize; ++i) valid.lanes[i] = packet.spreads[i] > 0.0F ? -1 : 0;
  RTCIntersectContext context = CoherentRays();
  rtcIntersect16(valid.lanes.data(), world_.embree_scene(), &context, &query);

  PacketHits hits;
  for (std::size_t i = 0; i < kSize; ++i) {
    const bool sky = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID;
    hits.surface[i] = sky ? PacketHits::kSky : query.hit.primID[i];
    hits.depth_m[i] = sky ? PacketHits::kSkyDepth_m : query.ray.tfar[i];
  }
  std::copy_n(query.hit.u, kSize, hits.b.begin());
  std::copy_n(query.hit.v, kSize, hits.c.begin());
  if (actors_.empty()) return hits;
  const RayBundle bundle = BundleOf(query.ray, valid);
  for (const PlacedPart& part : actors_) {
    if (MayMeet(bundle, part)) FindOnPart(part, query, valid, hits);
  }
  return hits;
}

const PlacedPart* ViewTracer::PartOf(std::uint32_t surface) const {
  if (surface < world_.surfaces().size()) return nullptr;
  const auto found = std::find_if(actors_.begin(), actors_.end(), [&](const PlacedPart& part) {
    return surface < part.first_surface + part.body->surfaces().size();
  });
  return found == actors_.end() ? nullptr : &*found;
}

void ViewTracer::ShadeSurface(const RayPacket& packet, const PacketHits& hits, std::size_t ray,
                              Lit& lit) const {
  const PlacedPart* part = PartOf(hits.surface[ray]);
  const World& body = part == nullptr ? world_ : *part->body;
  const Surface& surface =
      body.surfaces()[hits.surface[ray] - (part == nullptr ? 0U : part->first_surface)];
  const Paint& paint = body.paint(surface.material);
  Eigen::Vector3f direction = packet.Direction(ray);
  if (part != nullptr) direction = part->part_from_world.linear() * direction;
  const float facing = -direction.dot(surface.normal);
  Eigen::Vector3f normal = facing < 0.0F ? Eigen::Vector3f(-surface.normal) : surface.normal;
  if (part != nullptr) normal = part->world_from_part.linear() * normal;
  const float b = hits.b[ray];
  const float c = hits.c[ray];
  lit.normal[ray] = normal;
  lit.albedo[ray] = paint.gray;
  if (paint.texture != nullptr) {
    const Eigen::Vector2f uv = surface.uv + b * surface.uv_b + c * surface.uv_c;
    const float width_m = hits.depth_m[ray] * packet.spreads[ray];
    lit.albedo[ray] *= TextureGray(*paint.texture, surface, direction, uv, width_m,
                                   std::abs(facing), packet.most_lookups);
  }
  if (paint.glows) {
    lit.light[ray] = 1.0F;
    return;
  }
  const float shade =
      (1.0F - b - c) * surface.shade[0] + b * surface.shade[1] + c * surface.shade[2];
  lit.light[ray] = AmbientLight(lighting_, normal) * shade;
  lit.sun[ray] = lighting_.sun * std::max(0.0F, normal.dot(lighting_.toward_sun));
}

float ViewTracer::SkyGray(float direction_z) const {
  const float height = std::sqrt(std::clamp(direction_z, 0.0F, 1.0F));
  return GrayOf(lighting_.sky_horizon + height * (lighting_.sky_zenith - lighting_.sky_horizon));
}

void ViewTracer::CastShadows(const RayPacket& packet, const PacketHits& hits, Lit& lit,
                             RayPacket::Lanes<bool>& in_shadow) const {
  RayMask wanted;
  RTCRay16 rays;
  FillDefaults(rays);
  std::fill_n(rays.dir_x, kSize, lighting_.toward_sun.x());
  std::fill_n(rays.dir_y, kSize, lighting_.toward_sun.y());
  std::fill_n(rays.dir_z, kSize, lighting_.toward_sun.z());
  for (std::size_t i = 0; i < kSize; ++i) {
    wanted.lanes[i] = lit.sun[i] > 0.0F ? -1 : 0;
    const Eigen::Vector3f from =
        packet.origin + hits.depth_m[i] * packet.Direction(i) + kShadowOffset_m * lit.normal[i];
    rays.org_x[i] = from.x();
    rays.org_y[i] = from.y();
    rays.org_z[i] = from.z();
  }
  if (!wanted.any()) return;
  RTCIntersectContext context = CoherentRays();
  rtcOccluded16(wanted.lanes.data(), world_.embree_scene(), &context, &rays);
  if (!actors_.empty()) {
    const RayBundle bundle = BundleOf(rays, wanted);
    for (const PlacedPart& part : actors_) {
      if (MayMeet(bundle, part)) ShadowOfPart(part, wanted, rays);
    }
  }
  for (std::size_t i = 0; i < kSize; ++i) {
    if (wanted.lanes[i] == 0 || !(rays.tfar[i] < 0.0F)) continue;
    lit.sun[i] = 0.0F;
    in_shadow[i] = true;
  }
}

PacketView ViewTracer::Shade(const RayPacket& packet, const PacketHits& hits) const {
  PacketView view;
  Lit lit;
  for (std::size_t i = 0; i < kSize; ++i) {
    lit.normal[i].setZero();
    if (!(packet.spreads[i] > 0.0F)) continue;
    if (hits.surface[i] == PacketHits::kSky) {
      lit.albedo[i] = SkyGray(packet.z[i]);
      lit.light[i] = 1.0F;
    } else {
      ShadeSurface(packet, hits, i, lit);
    }
  }
  if (lighting_.sun > 0.0F) CastShadows(packet, hits, lit, view.in_shadow);
  // Grey levels are about the square root of light (gamma 2), in textures and in pictures.
  for (std::size_t i = 0; i < kSize; ++i) {
    view.gray[i] = lit.albedo[i] * std::sqrt(lit.light[i] + lit.sun[i]);
  }
  return view;
}

}  // namespace trailcast::sim
