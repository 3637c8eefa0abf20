
#include "services/lab/sim/places/src/outdoor_kit.h"
#include "services/lab/sim/places/src/parking_lot.h"
#include "services/lab/sim/places/src/parking_row.h"

#include "services/lab/sim/core/angles.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kLoopSeed = 1966;
constexpr float kNorth = kPi / 2.0F;
constexpr float kSouth = -kPi / 2.0F;
constexpr float kEast = 0.0F;
constexpr float kWest = kPi;
// The path's straight sections run along these.
constexpr float kEastSide_m = 124.0F;
constexpr float kNorthSide_m = 74.0F;

void LayGround(Paving& paving) {
  paving.LawnGround({{-90, -80}, {230, 170}});
  paving.AsphaltGround({{-6, -10}, {135, 90}}, 1);
  paving.Pavement({{-6, -13.5F}, {135, -10}});
  paving.Pavement({{135, -10}, {138, 90}});
  paving.Wear({{4, -4}, {kEastSide_m - 4, 4}}, 0.05F);
  paving.Wear({{kEastSide_m - 5, 0}, {kEastSide_m + 4, kNorthSide_m}}, 0.05F);
  paving.Wear({{0, kNorthSide_m - 6}, {kEastSide_m, kNorthSide_m + 8}}, 0.025F);
  paving.Wear({{-4, 4}, {5, kNorthSide_m - 4}}, 0.05F);
  for (const float x : {20.0F, 60.0F, 100.0F}) {
    paving.Arrow({x, -2.0F}, kEast);
    paving.LawnIsland({{x - 1.5F, 4.6F}, {x + 1.5F, 14.6F}});
  }
  paving.Arrow({kEastSide_m - 2.2F, 30}, kNorth);
  paving.Arrow({80, kNorthSide_m + 2.2F}, kWest);
  paving.Arrow({2.2F, 50}, kSouth);
  paving.LawnIsland({{7, 18}, {10, 60}});
  paving.LawnIsland({{112, 62}, {118, 66}});
}

void ParkCars(OutdoorKit& kit) {
  ParkingRows rows(kit.paving, kit.vehicles, kLoopSeed);
  rows.Fill({.corner = {2, -9.6F}, .bays = 48, .nose = kSouth, .share = 0.6});
  for (const float x : {21.5F, 61.5F}) {
    rows.Fill({.corner = {x, 4.6F}, .bays = 14, .nose = kSouth, .share = 0.65});
    rows.Fill({.corner = {x, 9.6F}, .bays = 14, .nose = kNorth, .share = 0.5});
  }
  rows.Fill({.corner = {129.6F, 6}, .along_x = false, .bays = 24, .nose = kEast, .share = 0.6});
  rows.Fill({.corner = {113.4F, 8}, .along_x = false, .bays = 16, .nose = kWest, .share = 0.55});
  rows.Fill({.corner = {24, 28}, .bays = 26, .nose = kNorth, .share = 0.35});
  rows.Fill({.corner = {12, 20}, .along_x = false, .bays = 12, .nose = kWest, .share = 0.5});
  kit.vehicles.Park(30, 52, 0.4F, VehicleShape::kVan);
  kit.vehicles.Park(104, 83, kWest, VehicleShape::kVan);
}

void PutUpLoopBuildings(Buildings& buildings) {
  using Wall = Buildings::Wall;
  buildings.Stand(26, -16, kPi);
  buildings.PutUp(Buildings::Block{.width_m = 34, .storeys = 3});
  buildings.Stand(76, -17, kPi);
  buildings.PutUp(
      Buildings::Block{.width_m = 42, .storeys = 2, .wall = Wall::kWhitePlaster, .shops = true});
  buildings.Stand(124, -18, kPi);
  buildings.PutUp(Buildings::Block{.width_m = 36, .storeys = 4, .wall = Wall::kConcrete});
  buildings.Stand(146, 40, kSouth);
  buildings.PutUp(Buildings::Block{.width_m = 44, .storeys = 3, .wall = Wall::kDarkBrick});
  buildings.Stand(148, 92, kSouth);
  buildings.PutUp(Buildings::Block{.width_m = 34, .storeys = 2, .wall = Wall::kYellowPlaster});
  buildings.Stand(70, 118, 0);
  buildings.PutUp(Buildings::Block{.width_m = 46, .storeys = 3, .wall = Wall::kConcrete});
  buildings.Stand(0, 122, 0);
  buildings.PutUp(Buildings::Block{.width_m = 40, .storeys = 2});
  for (const float y : {2.0F, 18.0F, 34.0F, 50.0F, 66.0F}) {
    buildings.Stand(-24, y, kNorth);
    buildings.PutUp(Buildings::House{.width_m = 10,
                                     .wall = y > 30.0F ? Wall::kWhitePlaster : Wall::kBrick,
                                     .garage = y < 30.0F});
  }
}

void Plant(Vegetation& plants) {
  constexpr Vegetation::Detail kBeside = {8.0F, 0.34F};
  for (const float x : {20.0F, 60.0F, 100.0F}) {
    plants.Stand(x, 7.0F);
    plants.Tree(5.6F, 1.8F, kBeside);
    plants.Stand(x, 11.5F);
    plants.Bush(0.9F, 1.1F, kBeside);
  }
  for (float y = 20.0F; y < 60.0F; y += 8.0F) {
    plants.Stand(8.5F, y);
    plants.Tree(6.0F, 1.9F, kBeside);
    plants.Stand(8.5F, y + 4.0F);
    plants.Bush(0.8F, 1.0F, kBeside);
  }
  plants.Stand(115, 64);
  plants.Tree(6.5F, 2.2F, kBeside);
  plants.Hedge({-7.2F, -9}, {-7.2F, 66}, 1.4F, 0.9F, Vegetation::kAcross);
  plants.Hedge({139, -8}, {139, 60}, 1.1F, 0.9F, Vegetation::kAcross);
  for (float x = 4.0F; x < 134.0F; x += 13.0F) {
    plants.Stand(x, -12.0F, 0.1F);
    plants.Tree(6.4F, 2.1F);
  }
  for (float y = 2.0F; y < 84.0F; y += 12.0F) {
    plants.Stand(141.5F, y);
    plants.Tree(7.0F, 2.5F);
    plants.Stand(-11.0F, y + 3.0F);
    plants.Tree(7.5F, 2.7F);
  }
  for (float x = -20.0F; x < 150.0F; x += 9.0F) {  // the far side of the meadow in the north
    plants.Stand(x, 108.0F + 0.03F * x);
    plants.Tree(9.0F + 0.02F * x, 3.4F, Vegetation::kFar);
  }
}

void SetOutFurniture(StreetFurniture& street) {
  for (const float x : {0.0F, 30.0F, 76.0F, 106.0F}) {
    street.Stand(x, x == 0.0F ? -9.0F : 9.6F, kPi);
    street.LampPost();
  }
  for (const float y : {4.0F, 28.0F, 52.0F}) {
    street.Stand(129.0F, y, kSouth);
    street.LampPost();
    street.Stand(10.2F, y + 10.0F, kNorth);
    street.LampPost();
  }
  for (const float x : {21.2F, 61.2F, 101.2F}) {
    street.Stand(x, 4.9F);
    street.ParkingSign();
  }
  for (const float y : {12.0F, 40.0F}) {
    street.Stand(-5.0F, y, kNorth);
    street.Bench();
    street.Stand(-5.0F, y + 2.4F, kNorth);
    street.LitterBin();
  }
  for (int i = 0; i < 5; ++i) {
    street.Stand(118.0F + 1.6F * static_cast<float>(i), 78.5F);
    street.Bollard();
    street.Stand(-4.6F, 60.0F + 1.6F * static_cast<float>(i));
    street.Bollard();
  }
  street.StandAlong({-6, 90.5F}, {135, 90.5F});
  street.RailFence(141, 1.2F);
  street.Stand(58, -11.0F, 0.0F, 0.1F);
  street.Bench();
}

}  // namespace

Result<Place> MakeLoopWorld() {
  OutdoorKit kit(kLoopSeed);
  LayGround(kit.paving);
  ParkCars(kit);
  PutUpLoopBuildings(kit.buildings);
  Plant(kit.plants);
  SetOutFurniture(kit.street);
  return FinishOutdoors(kit, "loop", GroundMode::kFlat,
                        {{30, 0},     {55, 0.7},   {85, -0.6},  {114, 0.2},  {121, 2.6}, {124, 9},
                         {123.4, 30}, {124.4, 52}, {124, 65},   {121, 71.4}, {114, 74},  {85, 74.8},
                         {48, 73.4},  {10, 74},    {2.8, 71.4}, {0, 65},     {0.7, 44},  {-0.5, 24},
                         {0, 9},      {2.8, 2.6},  {9, 0},      {30, 0}});
}

}  // namespace trailcast::sim
