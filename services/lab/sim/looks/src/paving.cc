#include "services/lab/sim/looks/paving.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V2 = Eigen::Vector2f;
using V = Eigen::Vector3f;

constexpr float kLayer_m = 0.002F;
constexpr float kPatch_m = 0.010F;
constexpr float kTar_m = 0.012F;
constexpr float kPaint_m = 0.014F;
constexpr float kKerb_m = 0.12F;
constexpr float kKerbWidth_m = 0.15F;

V At(const V2& place, float z_m) { return {place.x(), place.y(), z_m}; }

}  // namespace

std::array<GroundArea, 4> Around(const GroundArea& area, const GroundArea& hole) {
  return {{{area.low, {hole.low.x(), area.high.y()}},
           {{hole.high.x(), area.low.y()}, area.high},
           {{hole.low.x(), area.low.y()}, {hole.high.x(), hole.low.y()}},
           {{hole.low.x(), hole.high.y()}, {hole.high.x(), area.high.y()}}}};
}

Paving::Paving(SceneBuilder& builder, std::uint64_t seed) : b_(builder), random_(seed, "paving") {
  const V white(255, 255, 255);
  const auto asphalt = Asphalt({126, 125, 122}, seed);
  asphalt_ = b_.AddMaterial("asphalt", white, asphalt);
  mended_ = b_.AddMaterial("mended asphalt", {196, 196, 198}, asphalt);
  oily_ = b_.AddMaterial("oily asphalt", {222, 220, 218}, asphalt);
  lawn_ = b_.AddMaterial("lawn", white, Lawn(seed));
  slabs_ = b_.AddMaterial("slabs", white, Slabs(seed));
  concrete_ = b_.AddMaterial("concrete", white, Concrete({164, 161, 154}, seed));
  paint_ = b_.AddMaterial("road paint", white, WornPaint(seed));
  tar_ = b_.AddMaterial("tar", {58, 57, 56});
  manhole_ = b_.AddMaterial("manhole", white, ManholeCover());
}

float Paving::Between(float low, float high) {
  return static_cast<float>(random_.Uniform(low, high));
}

void Paving::Ground(MaterialId material, const GroundArea& area, float z_m, float tile_m) {
  const V2 size = area.high - area.low;
  b_.Place({0, 0, 0}, 0);
  // The texture is placed in world coordinates, so that neighbouring areas match.
  b_.Panel(material, {area.low.x(), area.high.y(), z_m}, {size.x(), 0, 0}, {0, -size.y(), 0},
           {{area.low.x() / tile_m, -area.high.y() / tile_m},
            {area.high.x() / tile_m, -area.low.y() / tile_m}});
}

void Paving::AsphaltGround(const GroundArea& area, int layer) {
  Ground(asphalt_, area, kLayer_m * static_cast<float>(layer), 4.0F);
}
void Paving::LawnGround(const GroundArea& area, int layer) {
  Ground(lawn_, area, kLayer_m * static_cast<float>(layer), 2.5F);
}
void Paving::SlabGround(const GroundArea& area, int layer) {
  Ground(slabs_, area, kLayer_m * static_cast<float>(layer), 2.0F);
}

void Paving::LawnIsland(const GroundArea& area) {
  Ground(lawn_, area, kKerb_m - 0.01F, 2.5F);
  Kerbs(area);
}

void Paving::Pavement(const GroundArea& area) {
  Ground(slabs_, area, kKerb_m - 0.005F, 2.0F);
  Kerbs(area);
}

void Paving::Kerbs(const GroundArea& area) {
  const V2 other(area.high.x(), area.low.y());
  const V2 opposite(area.low.x(), area.high.y());
  Kerb(area.low, other);
  Kerb(other, area.high);
  Kerb(area.high, opposite);
  Kerb(opposite, area.low);
}

// A kerb has stones of a metre with joints between.
void Paving::Kerb(const V2& from, const V2& to) {
  const V2 along = to - from;
  b_.Place(At(from, 0.0F), std::atan2(along.y(), along.x()));
  const float length = along.norm();
  for (float x = 0.0F; x < length - 0.05F; x += 1.0F) {
    b_.Box(concrete_, {x, 0.0F, -0.02F}, {std::min(x + 0.985F, length), kKerbWidth_m, kKerb_m},
           2.3F);
  }
  b_.Place({0, 0, 0}, 0);
}

void Paving::Strip(MaterialId material, const V2& from, const V2& to, float width_m, float z_m,
                   float tile_m) {
  const V2 along = to - from;
  const V2 side = 0.5F * width_m * V2(-along.y(), along.x()).normalized();
  const V2 uv(Between(0.0F, 1.0F), Between(0.0F, 1.0F));
  b_.Quad(material,
          {At(from + side, z_m), At(from - side, z_m), At(to - side, z_m), At(to + side, z_m)},
          {uv, uv + V2(along.norm(), width_m) / tile_m});
}

void Paving::Line(const V2& from, const V2& to, float width_m) {
  b_.Place({0, 0, 0}, 0);
  Strip(paint_, from, to, width_m, kPaint_m, 2.0F);
}

void Paving::BayLines(const V2& corner, const V2& step, const V2& depth, int count) {
  for (int i = 0; i <= count; ++i) {
    const V2 from = corner + static_cast<float>(i) * step;
    Line(from, from + depth);
  }
}

void Paving::Arrow(const V2& tail, float heading_rad) {
  const V2 ahead(std::cos(heading_rad), std::sin(heading_rad));
  const V2 left(-ahead.y(), ahead.x());
  Line(tail, tail + 1.6F * ahead, 0.16F);
  const V2 tip = tail + 2.5F * ahead;
  const V2 neck = tail + 1.5F * ahead;
  b_.Quad(paint_, {At(neck + 0.4F * left, kPaint_m), At(neck - 0.4F * left, kPaint_m),
                   At(tip - 0.02F * left, kPaint_m), At(tip + 0.02F * left, kPaint_m)});
}

void Paving::Crack(const V2& from, const V2& to) {
  const V2 along = to - from;
  const V2 left = V2(-along.y(), along.x()).normalized();
  const int pieces = std::max(3, static_cast<int>(along.norm() / 0.25F));
  b_.Place({0, 0, 0}, 0);
  V2 last = from;
  float off = 0.0F;
  for (int i = 1; i <= pieces; ++i) {
    off = 0.85F * off + Between(-0.09F, 0.09F);
    const V2 next =
        from + along * (static_cast<float>(i) / static_cast<float>(pieces)) + off * left;
    Strip(tar_, last, next, Between(0.010F, 0.028F), kTar_m, 1.0F);
    last = next;
  }
}

void Paving::Patch(const V2& middle, const V2& size, float yaw_rad) {
  b_.Place(At(middle, 0.0F), yaw_rad);
  const V2 half = 0.5F * size;
  const V2 uv(Between(0.0F, 1.0F), Between(0.0F, 1.0F));
  b_.Quad(mended_,
          {V(-half.x(), half.y(), kPatch_m), V(-half.x(), -half.y(), kPatch_m),
           V(half.x(), -half.y(), kPatch_m), V(half.x(), half.y(), kPatch_m)},
          {uv, uv + size / 4.0F});
  const std::array<V2, 4> corners = {
      {{-half.x(), half.y()}, {-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}}};
  for (std::size_t i = 0; i < 4; ++i) {
    Strip(tar_, corners[i], corners[(i + 1) % 4], 0.035F, kTar_m, 1.0F);
  }
}

void Paving::Stain(const V2& middle, float radius_m) {
  constexpr std::uint32_t kCorners = 11;
  Mesh piece;
  const auto corner = [&](const V2& place) {
    piece.positions.push_back(At(place, kPatch_m));
    piece.uvs.emplace_back(place / 4.0F);
  };
  corner(middle);
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const float angle = kFullTurn * static_cast<float>(i) / kCorners;
    corner(middle + radius_m * Between(0.6F, 1.1F) * V2(std::cos(angle), std::sin(angle)));
    piece.triangles.push_back({0, 1 + i, 1 + (i + 1) % kCorners});
  }
  b_.Place({0, 0, 0}, 0);
  b_.Add(oily_, piece);
}

void Paving::Manhole(const V2& middle) {
  b_.Place({0, 0, 0}, 0);
  b_.Disc(manhole_, At(middle, kPaint_m), V::UnitZ(), 0.36F, 18);
}

void Paving::Wear(const GroundArea& area, float density_per_m2) {
  constexpr float kReach_m = 2.0F;
  const V2 room = (area.high - area.low - V2::Constant(2.0F * kReach_m)).cwiseMax(0.0F);
  const V2 corner = 0.5F * (area.low + area.high - room);
  const V2 size = area.high - area.low;
  for (int i = static_cast<int>(size.x() * size.y() * density_per_m2); i > 0; --i) {
    const V2 share(Between(0.0F, 1.0F), Between(0.0F, 1.0F));
    WearSpot(corner + room.cwiseProduct(share), 0.0F, kReach_m);
  }
}

void Paving::WearSpot(const V2& middle, float heading_rad, float reach_m) {
  const float kind = Between(0.0F, 1.0F);
  if (kind < 0.45F) {
    const float angle = Between(0.0F, kFullTurn);
    const V2 half = reach_m * Between(0.3F, 1.0F) * V2(std::cos(angle), std::sin(angle));
    Crack(middle - half, middle + half);
  } else if (kind < 0.55F) {
    const V2 size(Between(0.35F, 1.2F), Between(0.3F, 0.65F));
    Patch(middle, reach_m * size, heading_rad + Between(-0.1F, 0.1F));
  } else if (kind < 0.95F) {
    Stain(middle, Between(0.08F, 0.4F));
  } else {
    Manhole(middle);
  }
}

}  // namespace trailcast::sim
