#include "services/lab/sim/places/src/rooms.h"

#include <array>
#include <cmath>
#include <utility>

#include "services/lab/sim/looks/indoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;
using V2 = Eigen::Vector2f;

constexpr float kSkirting_m = 0.08F;
constexpr float kPassage_m = 2.1F;

V2 Direction(float yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

}  // namespace

Rooms::Rooms(SceneBuilder& builder, Furniture& furniture, std::uint64_t seed)
    : b_(builder), furniture_(furniture) {
  const V white(255, 255, 255);
  carpet_ = b_.AddMaterial("office carpet", white, CarpetTiles({104, 100, 96}, seed));
  lino_ = b_.AddMaterial("plain floor", {148, 146, 138});
  tiles_ = b_.AddMaterial("ceiling tiles", white, CeilingTiles(seed));
  white_ = b_.AddMaterial("plain ceiling", {216, 216, 212});
  painted_ = b_.AddMaterial("office plaster", white, Plaster({198, 196, 186}, seed));
  plain_wall_ = b_.AddMaterial("plain wall", {198, 196, 188});
  skirting_ = b_.AddMaterial("office skirting", {104, 100, 94});
  glow_ = b_.AddMaterial("office lamp", {250, 250, 246}, nullptr, true);
  lamp_frame_ = b_.AddMaterial("office lamp frame", {188, 188, 188});
  constexpr std::array<const char*, 5> kSigns = {"2.01", "2.02", "STORE", "2.04", "EXIT"};
  for (const char* sign : kSigns) {
    doors_.push_back(b_.AddMaterial("office door", white, DoorLeaf(sign)));
  }
}

void Rooms::FloorAndCeiling(const V2& corner, float yaw_rad, const V2& size, Look look, float z_m) {
  b_.Place({corner.x(), corner.y(), 0.0F}, yaw_rad);
  const bool plain = look == Look::kPlain;
  const V x(size.x(), 0, 0);
  const V y(0, size.y(), 0);
  b_.Panel(plain ? lino_ : carpet_, y + V(0, 0, z_m), x, -y, {{0, 0}, size});
  b_.Panel(plain ? white_ : tiles_, {0, 0, kHeight_m - z_m}, x, y, {{0, 0}, size / 1.2F});
}

WallLine Rooms::Wall(const V2& from, const V2& to, Look look) {
  const V2 along = to - from;
  WallLine line{from, std::atan2(along.y(), along.x())};
  const float length = along.norm();
  b_.Place({from.x(), from.y(), 0.0F}, line.yaw_rad);
  const bool plain = look == Look::kPlain;
  b_.Box(plain ? plain_wall_ : painted_, {0, 0, -0.01F}, {length, kWallThickness_m, kHeight_m},
         3.0F);
  if (!plain) b_.Box(skirting_, {0, -0.015F, 0}, {length, 0, kSkirting_m});
  return line;
}

void Rooms::Lintel(const V2& from, const V2& to) {
  const V2 along = to - from;
  b_.Place({from.x(), from.y(), 0.0F}, std::atan2(along.y(), along.x()));
  const float length = along.norm();
  b_.Box(painted_, {0, 0, kPassage_m}, {length, 2.0F * kWallThickness_m + 0.02F, kHeight_m}, 3.0F);
  for (const float x : {0.0F, length - 0.05F}) {
    b_.Box(skirting_, {x, -0.02F, 0}, {x + 0.05F, 2.0F * kWallThickness_m + 0.04F, kPassage_m});
  }
}

void Rooms::CeilingLamp(const V2& middle, float yaw_rad) {
  b_.Place({middle.x(), middle.y(), 0.0F}, yaw_rad);
  constexpr float kLow_m = kHeight_m - 0.06F;
  b_.Box(lamp_frame_, {-0.62F, -0.17F, kLow_m}, {0.62F, 0.17F, kHeight_m - 0.001F});
  b_.Panel(glow_, {-0.6F, -0.15F, kLow_m - 0.004F}, {1.2F, 0, 0}, {0, 0.3F, 0});
  lamps_.push_back({{middle.x(), middle.y(), kLow_m - 0.06F}, -V::UnitZ(), 1.7F});
}

void Rooms::Fit(const WallLine& wall, const std::vector<FittingAt>& fittings) {
  for (const FittingAt& fitting : fittings) {
    const V2 at = wall.left_end + fitting.along_m * Direction(wall.yaw_rad);
    b_.Place({at.x(), at.y(), 0.0F}, wall.yaw_rad);
    FitOne(fitting.what);
  }
}

void Rooms::FitOne(Fitting what) {
  const Eigen::Isometry3f frame = b_.place();
  const auto shift = [&](float x, float y, float z) { b_.PlaceIn(frame, {x, y, z}, 0.0F); };
  switch (what) {
    case Fitting::kDoor:
      return furniture_.Door(doors_[next_door_++ % doors_.size()]);
    case Fitting::kPoster:
      shift(0, 0, 1.0F);
      return furniture_.Hang(furniture_.poster(), 0.6F, 0.85F);
    case Fitting::kNotices:
      shift(0, 0, 1.25F);
      furniture_.Hang(furniture_.page(), 0.3F, 0.42F);
      shift(0.4F, 0, 1.1F);
      return furniture_.Hang(furniture_.page(), 0.21F, 0.3F);
    case Fitting::kWhiteboard:
      shift(0, 0, 1.0F);
      return furniture_.Hang(furniture_.whiteboard(), 1.6F, 0.9F);
    case Fitting::kWindow:
      shift(0, 0, 0.95F);
      return furniture_.Window(1.4F, 1.25F);
    case Fitting::kRadiator:
      return furniture_.Radiator(1.2F);
    case Fitting::kShelf:
      shift(0, -0.32F, 0);
      return furniture_.Shelf(1.1F, 1.9F, 0.30F, 5);
    case Fitting::kCupboard:
      shift(0, -0.36F, 0);
      return furniture_.Cupboard(0.85F, 1.5F, 0.34F);
    case Fitting::kPlant:
      shift(0, -0.22F, 0);
      return furniture_.Plant();
    case Fitting::kBin:
      shift(0, -0.18F, 0);
      return furniture_.Bin();
  }
}

Result<Place> FinishIndoors(Scene scene, const std::vector<Lamp>& lamps, Polyline points,
                            float ambient) {
  scene.ground = GroundMode::kFlat;
  scene.lighting.sun = 0.0F;
  scene.lighting.ambient = 1.0F;
  scene.lighting.ambient_by_direction = false;  // the baked light includes it
  if (auto baked = BakeLight(lamps, scene, ambient); !baked) return tl::unexpected(baked.error());
  auto world = World::Build(std::move(scene));
  if (!world) return tl::unexpected(world.error());
  Place place;
  place.world = std::move(*world);
  place.path.points = std::move(points);
  return place;
}

}  // namespace trailcast::sim
