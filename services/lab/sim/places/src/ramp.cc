#include "services/lab/sim/places/src/ramp.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/terrain.h"
#include "services/lab/sim/places/src/outdoor_kit.h"
#include "services/lab/sim/places/src/parking_row.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kRampSeed = 1931;
constexpr float kFoot_m = 5.0F;  // where the ramp begins
constexpr float kHigh_m = 1.0F;
constexpr float kSlope = 0.070F;  // 4 degrees
constexpr float kLevel_m = 2.0F;  // at the top
constexpr float kRise_m = kHigh_m / kSlope;
constexpr float kEnd_m = kFoot_m + 2.0F * kRise_m + kLevel_m;
constexpr float kHalfWidth_m = 1.6F;
constexpr float kLean = 0.022F;  // sideways, 1.3 degrees

// Returns the height of the ramp's middle, whose edges are rounded off over a metre.
float MiddleHeight(float x) {
  constexpr int kSteps = 8;
  constexpr float kRound_m = 1.0F;
  float sum = 0.0F;
  for (int i = 0; i < kSteps; ++i) {
    const float at = x + kRound_m * ((static_cast<float>(i) + 0.5F) / kSteps - 0.5F);
    sum += std::clamp(kSlope * std::min(at - kFoot_m, kEnd_m - at), 0.0F, kHigh_m);
  }
  return sum / kSteps;
}

float RampHeight(float x, float y) {
  const float height = MiddleHeight(x);
  return height + kLean * y * std::min(1.0F, 4.0F * height);
}

void BuildRamp(OutdoorKit& kit) {
  const auto surface =
      kit.builder.AddMaterial("ramp", {255, 255, 255}, Concrete({148, 145, 138}, kRampSeed));
  kit.builder.Place({0, 0, 0.004F}, 0);
  const float half = kHalfWidth_m + 0.1F;
  AddHeightField(kit.builder, surface,
                 {kFoot_m - 0.5F, kFoot_m - 0.5F, kEnd_m + 0.5F, kEnd_m + 0.5F, 0.25F},
                 {-half, -half, half, half, 0.6F}, 3.0F, RampHeight);
  constexpr float kSpan_m = 2.4F;  // the walls rise in steps
  for (float x = kFoot_m + 0.6F; x + kSpan_m < kEnd_m; x += kSpan_m) {
    const float high = MiddleHeight(x + 0.5F * kSpan_m) + 0.30F;
    kit.street.Stand(x, kHalfWidth_m);
    kit.street.GardenWall(kSpan_m, high);
    kit.street.Stand(x, -kHalfWidth_m - 0.24F);
    kit.street.GardenWall(kSpan_m, high);
    kit.street.Stand(x, -kHalfWidth_m - 0.12F, 0.0F, high + 0.06F);
    kit.street.Railing(kSpan_m, 0.7F);
  }
}

void LayGround(OutdoorKit& kit) {
  const GroundArea lot = {{-8, -13}, {54, 4}};
  // There is nothing below the ramp, because robots need a single ground to stand on.
  const GroundArea ramp = {{kFoot_m, -kHalfWidth_m}, {kEnd_m, kHalfWidth_m}};
  for (const GroundArea& area : Around({{-60, -60}, {120, 70}}, lot)) kit.paving.LawnGround(area);
  for (const GroundArea& area : Around(lot, ramp)) kit.paving.AsphaltGround(area);
  kit.paving.Wear({{-5, -4}, {kFoot_m, 4}}, 0.10F);
  kit.paving.Wear({{kEnd_m + 0.5F, -7}, {52, 4}}, 0.08F);
  kit.paving.Wear({{6, -12}, {34, -3}}, 0.02F);
  kit.paving.SlabGround({{-8, 4}, {54, 6}}, 1);
  kit.paving.LawnIsland({{10, -6.4F}, {13, -2.6F}});
  kit.paving.LawnIsland({{24, -6.4F}, {27, -2.6F}});
  kit.paving.LawnIsland({{43.0F, -3.2F}, {45.4F, -1.2F}});
  ParkingRows rows(kit.paving, kit.vehicles, kRampSeed);
  rows.Fill({.corner = {4, -12.6F}, .bays = 12, .nose = -kPi / 2.0F, .share = 0.75});
  rows.Fill({.corner = {47, -9}, .along_x = false, .bays = 3, .nose = kPi, .share = 1.0});
  kit.vehicles.ParkAny(49.5F, 1.6F, kPi / 2.0F);
}

void PutUpRampBuildings(Buildings& buildings) {
  buildings.Stand(-2, 6.0F, 0);
  buildings.PutUp(Buildings::Block{.width_m = 41, .depth_m = 12, .storeys = 3});
  buildings.Stand(57, 12, -kPi / 2.0F);
  buildings.PutUp(Buildings::Block{.width_m = 30,
                                   .depth_m = 11,
                                   .storeys = 2,
                                   .wall = Buildings::Wall::kYellowPlaster,
                                   .shops = true});
  for (const float x : {2.0F, 14.0F, 26.0F, 38.0F}) {
    buildings.Stand(x + 9, -24, kPi);
    buildings.PutUp(Buildings::House{.width_m = 9, .wall = Buildings::Wall::kWhitePlaster});
  }
}

void PlantAndFurnish(OutdoorKit& kit) {
  Vegetation& plants = kit.plants;
  plants.Hedge({-7, -13.8F}, {46, -13.8F}, 1.3F, 0.9F, Vegetation::kAcross);
  plants.Hedge({40.4F, 5.2F}, {52, 5.2F}, 1.1F, 0.7F, {12.0F, 0.27F});
  for (const float x : {11.4F, 25.4F}) {
    plants.Stand(x, -4.6F);
    plants.Tree(6.0F, 2.0F, {12.0F, 0.30F});
  }
  plants.Stand(44.2F, -2.2F);
  plants.Bush(0.8F, 1.0F);
  for (const float x : {-4.0F, 8.0F, 19.0F, 33.0F, 43.0F, 52.0F}) {
    plants.Stand(x, -17.0F);
    plants.Tree(8.0F, 2.9F, Vegetation::kAcross);
  }
  for (const float x : {42.0F, 47.0F, 52.0F}) {
    plants.Stand(x, 9.0F);
    plants.Tree(7.0F, 2.4F, Vegetation::kAcross);
  }
  StreetFurniture& street = kit.street;
  for (const float x : {2.6F, 19.0F, 37.5F}) {
    street.Stand(x, 3.6F);
    street.LampPost(4.5F);
  }
  for (const float y : {-2.4F, -3.6F, -4.8F}) {
    street.Stand(4.6F, y);
    street.Bollard();
    street.Stand(37.6F, y);
    street.Bollard();
  }
  street.Stand(3.4F, 2.6F, -0.6F);
  street.ParkingSign();
  street.Stand(40.6F, 3.4F);
  street.Bench();
  street.Stand(42.4F, 3.6F);
  street.LitterBin();
  street.Stand(38.6F, 4.7F, 0.2F);
  street.Bicycle();
}

}  // namespace

Result<Place> MakeRampWorld() {
  OutdoorKit kit(kRampSeed);
  LayGround(kit);
  BuildRamp(kit);
  PutUpRampBuildings(kit.buildings);
  PlantAndFurnish(kit);
  kit.lighting.toward_sun = kSunBehind;
  return FinishOutdoors(kit, "ramp", GroundMode::kMesh,
                        {{0, 0.5}, {7, 0.1}, {20, -0.25}, {34, 0.1}, {40.5, 0.9}});
}

}  // namespace trailcast::sim
