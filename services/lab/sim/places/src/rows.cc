#include "services/lab/sim/places/src/rows.h"

#include <cmath>

#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/places/src/outdoor_kit.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kRowsSeed = 1855;
constexpr int kRows = 40;
constexpr int kPlants = 17;  // in a row
constexpr float kPlantSpacing_m = 1.25F;
constexpr int kAisle = 19;      // of the way there, which lies between rows 19 and 20
constexpr int kBackAisle = 21;  // of the way back
constexpr int kSeenClosely = 3;

float RowAt_m(int row) {
  return static_cast<float>(kRowSpacing_m) * (static_cast<float>(row) - 0.5F * kRows);
}
double AisleAt_m(int aisle) { return RowAt_m(aisle) + 0.5 * kRowSpacing_m; }

void LayGround(SceneBuilder& builder) {
  constexpr float kTile_m = 5.0F;
  constexpr float kSide_m = 240.0F;
  const auto turf = builder.AddMaterial("turf", {255, 255, 255}, Turf(kRowsSeed));
  builder.Place({10.0F - 0.5F * kSide_m, -0.5F * kSide_m, 0}, 0);
  builder.Panel(turf, {0, kSide_m, 0}, {kSide_m, 0, 0}, {0, -kSide_m, 0},
                {{0, 0}, {kSide_m / kTile_m, kSide_m / kTile_m}});
}

void PlantRows(Vegetation& plants) {
  for (int row = 0; row < kRows; ++row) {
    const bool closely = std::abs(row - (kAisle + kBackAisle) / 2) <= kSeenClosely;
    for (int plant = 0; plant < kPlants; ++plant) {
      plants.Stand(kPlantSpacing_m * static_cast<float>(plant), RowAt_m(row));
      plants.Bush(0.5F, 1.3F, closely ? Vegetation::kNear : Vegetation::kFar);
    }
  }
}

// Whatever is far away looks the same from every aisle.
void PlantTreeLine(Vegetation& plants) {
  constexpr int kTrees = 60;
  Random random(kRowsSeed, "tree line");
  for (int i = 0; i < kTrees; ++i) {
    const double angle = 2.0 * kPi * (i + random.Uniform(-0.4, 0.4)) / kTrees;
    plants.Stand(static_cast<float>(10.0 + 85.0 * std::cos(angle)),
                 static_cast<float>(90.0 * std::sin(angle)));
    plants.Tree(static_cast<float>(random.Uniform(8.0, 14.0)),
                static_cast<float>(random.Uniform(3.2, 5.0)), Vegetation::kFar);
  }
}

}  // namespace

Result<Place> MakeRowsWorld() {
  OutdoorKit kit(kRowsSeed);
  LayGround(kit.builder);
  PlantRows(kit.plants);
  PlantTreeLine(kit.plants);
  kit.lighting.toward_sun = kSunBehind;
  const double there_m = AisleAt_m(kAisle);
  const double back_m = AisleAt_m(kBackAisle);
  const double far_m = kPlantSpacing_m * kPlants;
  return FinishOutdoors(kit, "rows", GroundMode::kFlat,
                        {{-2.0, there_m},
                         {far_m, there_m},
                         {far_m + 1.4, there_m + 0.9},
                         {far_m + 2.0, 0.5 * (there_m + back_m)},
                         {far_m + 1.4, back_m - 0.9},
                         {far_m, back_m},
                         {-2.0, back_m}});
}

}  // namespace trailcast::sim
