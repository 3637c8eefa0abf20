#include "services/lab/sim/places/src/field.h"

#include <cmath>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/places/src/outdoor_kit.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kFieldSeed = 1953;

void LayGrass(SceneBuilder& builder) {
  constexpr float kTile_m = 5.0F;
  constexpr float kSide_m = 360.0F;
  const auto turf = builder.AddMaterial("turf", {255, 255, 255}, Turf(kFieldSeed));
  builder.Place({15.0F - 0.5F * kSide_m, -0.5F * kSide_m, 0}, 0);
  builder.Panel(turf, {0, kSide_m, 0}, {kSide_m, 0, 0}, {0, -kSide_m, 0},
                {{0, 0}, {kSide_m / kTile_m, kSide_m / kTile_m}});
}

// The trees stand all round, thick in places and thin in others.
void PlantTreeLine(Vegetation& plants) {
  constexpr int kTrees = 84;
  Random random(kFieldSeed, "tree line");
  const auto between = [&](double low, double high) {
    return static_cast<float>(random.Uniform(low, high));
  };
  for (int i = 0; i < kTrees; ++i) {
    const float angle = 2.0F * kPi * (static_cast<float>(i) + between(-0.5, 0.5)) / kTrees;
    const float stretch = between(1.0, 1.25);
    plants.Stand(15.0F + 66.0F * stretch * std::cos(angle), 56.0F * stretch * std::sin(angle));
    const float kind = between(0.0, 1.0);
    if (kind < 0.2F) continue;
    if (kind < 0.35F) {
      plants.Conifer(between(9.0, 15.0), between(2.2, 3.2), Vegetation::kFar);
    } else if (kind < 0.55F) {
      plants.Bush(between(2.5, 4.0), between(2.0, 3.2), Vegetation::kFar);
    } else {
      plants.Tree(between(8.0, 14.0), between(3.2, 5.0), Vegetation::kFar);
    }
  }
}

void PutUpFieldBuildings(Buildings& buildings) {
  buildings.Stand(92, 20, -kPi / 2.0F);
  buildings.PutUp(
      Buildings::Block{.width_m = 30, .storeys = 4, .wall = Buildings::Wall::kConcrete});
  buildings.Stand(86, -18, -kPi / 2.0F - 0.3F);
  buildings.PutUp(Buildings::House{.width_m = 11, .wall = Buildings::Wall::kBrick});
  buildings.Stand(80, 44, -kPi / 2.0F + 0.5F);
  buildings.PutUp(Buildings::House{.width_m = 12, .wall = Buildings::Wall::kWhitePlaster});
  buildings.Stand(20, 64, 0.1F);
  buildings.PutUp(Buildings::Block{.width_m = 36, .storeys = 3});
  buildings.Stand(30, -62, kPi);
  buildings.PutUp(Buildings::Block{.width_m = 24, .wall = Buildings::Wall::kYellowPlaster});
}

}  // namespace

Result<Place> MakeFieldWorld() {
  OutdoorKit kit(kFieldSeed);
  LayGrass(kit.builder);
  PlantTreeLine(kit.plants);
  PutUpFieldBuildings(kit.buildings);
  kit.lighting.toward_sun = kSunBehind;
  return FinishOutdoors(kit, "field", GroundMode::kFlat,
                        {{0, 0}, {11, 1.2}, {21, -0.4}, {30, 1.0}});
}

}  // namespace trailcast::sim
