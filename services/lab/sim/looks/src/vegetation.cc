#include "services/lab/sim/looks/vegetation.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;

constexpr float kFoliageTile_m = 0.8F;
// The ambient light on a core and at the foot of a crown; its top has all of it.
constexpr float kCoreShade = 0.55F;
constexpr float kLowShade = 0.65F;

}  // namespace

Vegetation::Vegetation(SceneBuilder& builder, std::uint64_t seed)
    : b_(builder), random_(seed, "vegetation") {
  const V white(255, 255, 255);
  leaves_ = {b_.AddMaterial("maple leaves", white, Foliage({148, 168, 98}, seed)),
             b_.AddMaterial("lime leaves", white, Foliage({166, 178, 108}, seed + 1)),
             b_.AddMaterial("beech leaves", {224, 216, 212}, Foliage({144, 160, 112}, seed + 2))};
  needles_ = b_.AddMaterial("needles", {220, 228, 220}, Foliage({112, 134, 98}, seed + 3));
  hedge_ = b_.AddMaterial("hedge leaves", {225, 230, 220}, Foliage({128, 150, 90}, seed + 4));
  bark_ = b_.AddMaterial("bark", white, Bark(seed));
  blades_ = b_.AddMaterial("grass blades", {146, 150, 92});
}

void Vegetation::Stand(float x, float y, float z) { b_.Place({x, y, z}, Between(0.0F, kFullTurn)); }

float Vegetation::Between(float low, float high) {
  return static_cast<float>(random_.Uniform(low, high));
}

V Vegetation::AnyDirection() {
  const float z = Between(-1.0F, 1.0F);
  const float angle = Between(0.0F, kFullTurn);
  const float level = std::sqrt(1.0F - z * z);
  return {level * std::cos(angle), level * std::sin(angle), z};
}

std::size_t Vegetation::AnyKind() {
  return static_cast<std::size_t>(random_.Integer(0, static_cast<int>(leaves_.size()) - 1));
}

// Adds a ragged patch of leaves in the plane across `normal`, with a piece of the foliage on it.
void Vegetation::Cluster(const V& middle, const V& normal, float size_m, float shade, Mesh& piece) {
  constexpr std::uint32_t kTips = 5;
  const V side = normal.unitOrthogonal();
  const V other = normal.cross(side);
  const Eigen::Vector2f uv(Between(0.0F, 1.0F), Between(0.0F, 1.0F));
  const float start = Between(0.0F, kFullTurn);
  const auto first = static_cast<std::uint32_t>(piece.positions.size());
  for (std::uint32_t i = 0; i < kTips; ++i) {
    const float angle = start + kFullTurn * static_cast<float>(i) / kTips;
    const float reach = 0.5F * size_m * Between(0.5F, 1.3F);
    const Eigen::Vector2f at(reach * std::cos(angle), reach * std::sin(angle));
    piece.positions.emplace_back(middle + at.x() * side + at.y() * other);
    piece.uvs.emplace_back(uv + at / kFoliageTile_m);
    piece.shade.push_back(shade);
    if (i >= 2) piece.triangles.push_back({first, first + i - 1, first + i});
  }
}

// Adds what is visible between the leaves: a lumpy ball in the dark.
void Vegetation::Core(const Ball& ball, std::size_t kind) {
  constexpr std::uint32_t kRows = 4;
  constexpr std::uint32_t kColumns = 7;
  Mesh piece;
  for (std::uint32_t row = 0; row <= kRows; ++row) {
    const float tilt = 0.5F * kFullTurn * static_cast<float>(row) / kRows;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const float angle = kFullTurn * static_cast<float>(column) / kColumns;
      const V direction(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle),
                        std::cos(tilt));
      const V at = Between(0.72F, 0.92F) * ball.radii.cwiseProduct(direction);
      piece.positions.emplace_back(ball.middle + at);
      piece.uvs.emplace_back(ball.radii.x() * angle / kFoliageTile_m,
                             ball.radii.z() * tilt / kFoliageTile_m);
      piece.shade.push_back(kCoreShade);
      if (row == kRows) continue;
      const std::uint32_t a = row * kColumns + column;
      const std::uint32_t next = row * kColumns + (column + 1) % kColumns;
      piece.triangles.push_back({a, a + kColumns, next + kColumns});
      piece.triangles.push_back({a, next + kColumns, next});
    }
  }
  b_.Add(kind < leaves_.size() ? leaves_[kind] : needles_, piece);
}

void Vegetation::LeafBall(const Ball& ball, const Detail& detail, std::size_t kind) {
  Core(ball, kind);
  const float radius = ball.radii.mean();
  const auto count = static_cast<int>(2.0F * kFullTurn * radius * radius * detail.clusters_per_m2);
  Mesh piece;
  for (int i = 0; i < std::max(count, 6); ++i) {
    const V out = AnyDirection();
    const V at = ball.middle + Between(0.82F, 1.08F) * ball.radii.cwiseProduct(out);
    if (at.z() < 0.02F) continue;
    const float shade = kLowShade + (1.0F - kLowShade) * 0.5F * (1.0F + out.z());
    Cluster(at, (out + 0.55F * AnyDirection() + V(0, 0, 0.25F)).normalized(),
            detail.cluster_m * Between(0.7F, 1.3F), shade, piece);
  }
  b_.Add(leaves_[kind], piece);
}

void Vegetation::Trunk(float height_m, float radius_m) {
  b_.Tube(bark_, {0, 0, 0.25F}, {0, 0, height_m}, radius_m, 0.7F * radius_m, 9, 1.0F);
  b_.Tube(bark_, {0, 0, -0.1F}, {0, 0, 0.25F}, 1.35F * radius_m, radius_m, 9, 1.0F);
}

void Vegetation::Tree(float height_m, float crown_radius_m, const Detail& detail) {
  const std::size_t kind = AnyKind();
  const float clear = 0.34F * height_m;
  const float thick = 0.022F * height_m + 0.03F;
  Trunk(0.55F * height_m, thick);
  const float crown_half = 0.5F * (height_m - clear);
  const int balls = detail.cluster_m > 1.0F ? 4 : 6;
  for (int i = 0; i < balls; ++i) {
    const float angle = 2.39996F * static_cast<float>(i) + Between(0.0F, 0.5F);
    const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(balls);
    const float reach = crown_radius_m * 0.55F * std::sin(0.5F * kFullTurn * (0.2F + 0.7F * share));
    const V middle(reach * std::cos(angle), reach * std::sin(angle),
                   clear + crown_half * (0.45F + 1.25F * share));
    const float radius = crown_radius_m * Between(0.44F, 0.62F);
    b_.Tube(bark_, {0, 0, 0.9F * clear}, middle, 0.45F * thick, 0.2F * thick, 5, 1.0F);
    LeafBall({middle, {radius, radius, 0.85F * radius}}, detail, kind);
  }
}

void Vegetation::Conifer(float height_m, float radius_m, const Detail& detail) {
  Trunk(0.3F * height_m, 0.015F * height_m + 0.03F);
  Mesh piece;
  const int tiers = detail.cluster_m > 1.0F ? 6 : 11;
  for (int tier = 0; tier < tiers; ++tier) {
    const float share = (static_cast<float>(tier) + 0.3F) / static_cast<float>(tiers);
    const float z = height_m * (0.12F + 0.86F * share);
    const float radius = radius_m * (1.05F - share);
    b_.Tube(needles_, {0, 0, z - 0.5F * radius}, {0, 0, z + 0.7F * radius}, 0.8F * radius, 0.02F, 9,
            kFoliageTile_m);
    const int boughs = 5 + static_cast<int>(4.0F * radius * detail.clusters_per_m2);
    for (int i = 0; i < boughs; ++i) {
      const float angle = Between(0.0F, kFullTurn);
      const V out(std::cos(angle), std::sin(angle), 0.0F);
      const V at = V(0, 0, z - 0.32F * radius) + Between(0.7F, 1.0F) * radius * out;
      Cluster(at, (0.7F * out + V(0, 0, 0.8F) + 0.3F * AnyDirection()).normalized(),
              detail.cluster_m * Between(0.8F, 1.4F), kLowShade + (1.0F - kLowShade) * share,
              piece);
    }
  }
  b_.Add(needles_, piece);
}

void Vegetation::Bush(float radius_m, float height_m, const Detail& detail) {
  const std::size_t kind = AnyKind();
  for (int i = 0; i < 3; ++i) {
    const float angle = kFullTurn * static_cast<float>(i) / 3.0F + Between(0.0F, 0.8F);
    const float reach = 0.34F * radius_m;
    const float half = 0.5F * height_m * Between(0.8F, 1.0F);
    LeafBall({{reach * std::cos(angle), reach * std::sin(angle), half},
              {0.66F * radius_m, 0.66F * radius_m, half}},
             detail, kind);
  }
}

void Vegetation::Hedge(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float height_m,
                       float depth_m, const Detail& detail) {
  const Eigen::Vector2f along = to - from;
  const float length = along.norm();
  b_.Place({from.x(), from.y(), 0.0F}, std::atan2(along.y(), along.x()));
  const V ahead = V::UnitX();
  const V left = V::UnitY();
  const V up = V::UnitZ();
  const float inner = 0.5F * depth_m - 0.08F;
  const V corner = -inner * left;
  const V end = length * ahead;
  const V top = (height_m - 0.08F) * up;
  const TexturePart long_side = {{0, 0}, {length / kFoliageTile_m, height_m / kFoliageTile_m}};
  for (const float side : {-inner, inner}) {
    b_.Panel(hedge_, side * left + top, end, -top, long_side);
  }
  b_.Panel(hedge_, corner + top, end, 2.0F * inner * left, long_side);
  b_.Panel(hedge_, corner + top, 2.0F * inner * left, -top);
  b_.Panel(hedge_, corner + end + top, 2.0F * inner * left, -top);
  const float round = 2.0F * height_m + depth_m;  // up one side, over the top, down the other
  Mesh piece;
  for (int i = static_cast<int>(length * round * detail.clusters_per_m2); i > 0; --i) {
    const float over = Between(0.0F, round);
    V at = Between(0.0F, length) * ahead;
    V out = up;
    float z = height_m;
    if (over < height_m || over > height_m + depth_m) {
      z = over < height_m ? over : round - over;
      out = over < height_m ? V(-left) : left;
      at += 0.5F * depth_m * out;
    } else {
      at += (over - height_m - 0.5F * depth_m) * left;
    }
    at += Between(-0.06F, 0.05F) * out + std::max(z, 0.08F) * up;
    Cluster(at, (out + 0.6F * AnyDirection()).normalized(), detail.cluster_m * Between(0.6F, 1.2F),
            kLowShade + (1.0F - kLowShade) * z / height_m, piece);
  }
  b_.Add(hedge_, piece);
}

void Vegetation::Tussock(float radius_m, float height_m) {
  Mesh piece;
  for (std::uint32_t i = 0; i < 18; ++i) {
    const float angle = Between(0.0F, kFullTurn);
    const V out(std::cos(angle), std::sin(angle), 0.0F);
    const V side(-out.y(), out.x(), 0.0F);
    const V root = 0.4F * radius_m * Between(0.0F, 1.0F) * out;
    const V tip =
        root + Between(0.3F, 1.0F) * radius_m * out + Between(0.5F, 1.0F) * height_m * V::UnitZ();
    piece.positions.insert(piece.positions.end(), {root - 0.008F * side - V(0, 0, 0.03F),
                                                   root + 0.008F * side - V(0, 0, 0.03F), tip});
    piece.uvs.insert(piece.uvs.end(), 3, Eigen::Vector2f::Zero());
    piece.shade.insert(piece.shade.end(), {0.4F, 0.4F, 1.0F});
    piece.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  b_.Add(blades_, piece);
}

}  // namespace trailcast::sim
