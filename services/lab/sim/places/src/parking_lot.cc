#include "services/lab/sim/places/src/parking_lot.h"

#include <string>
#include <utility>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/places/src/outdoor_kit.h"
#include "services/lab/sim/places/src/parking_row.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kSeed = 1960;
constexpr float kNorth = kPi / 2.0F;
constexpr float kSouth = -kPi / 2.0F;

void LayGround(Paving& paving) {
  paving.LawnGround({{-60, -60}, {130, 90}});
  paving.AsphaltGround({{-14, -9.2F}, {68, 18}}, 1);
  paving.Pavement({{-14, 18}, {68, 23.5F}});
  paving.Wear({{-6, -3.2F}, {36, 3.8F}}, 0.09F);
  paving.Wear({{36, -3.2F}, {66, 12}}, 0.07F);
  paving.Wear({{-12, -9}, {66, -3.4F}}, 0.03F);
  paving.Arrow({4, -1.9F}, 0.0F);
  paving.Arrow({21, 2.0F}, kPi);
  paving.Arrow({41, 3.4F}, 0.4F);
  paving.LawnIsland({{34.4F, 4.0F}, {36.8F, 14.0F}});
  paving.LawnIsland({{15.2F, -8.6F}, {16.6F, -3.6F}});
  paving.LawnIsland({{60.0F, 8.9F}, {63.0F, 12.4F}});
  paving.LawnIsland({{50.0F, -1.4F}, {55.0F, 1.2F}});
  paving.LawnIsland({{-6.0F, 8.7F}, {34.4F, 9.3F}});
}

void ParkCars(OutdoorKit& kit) {
  ParkingRows rows(kit.paving, kit.vehicles, kSeed);
  rows.Fill({.corner = {-9.8F, -8.6F}, .bays = 10, .nose = kNorth, .share = 0.75});
  rows.Fill({.corner = {16.6F, -8.6F}, .bays = 19, .nose = kNorth, .share = 0.7});
  rows.Fill({.corner = {-6.0F, 3.7F}, .bays = 16, .nose = kSouth, .share = 0.7});
  rows.Fill({.corner = {-6.0F, 9.3F}, .bays = 16, .nose = kNorth, .share = 0.6});
  rows.Fill({.corner = {39.0F, 12.6F}, .bays = 10, .nose = kSouth, .share = 0.7});
  kit.vehicles.Park(66.2F, 4.0F, kSouth, VehicleShape::kVan);
  kit.vehicles.ParkAny(66.3F, -1.8F, kNorth);
}

void PutUpBuildings(Buildings& buildings) {
  buildings.Stand(-12, 24, 0);
  buildings.PutUp(Buildings::Block{.width_m = 30, .depth_m = 11, .storeys = 3});
  buildings.Stand(22, 25, 0);
  buildings.PutUp(Buildings::Block{.width_m = 34,
                                   .depth_m = 12,
                                   .storeys = 2,
                                   .wall = Buildings::Wall::kWhitePlaster,
                                   .shops = true});
  buildings.Stand(60, 26, 0);
  buildings.PutUp(
      Buildings::Block{.width_m = 18, .storeys = 4, .wall = Buildings::Wall::kConcrete});
  buildings.Stand(73, 14, kSouth);
  buildings.PutUp(Buildings::Block{
      .width_m = 26, .depth_m = 12, .storeys = 3, .wall = Buildings::Wall::kDarkBrick});
  for (const float x : {4.0F, 18.0F, 33.0F, 50.0F}) {
    buildings.Stand(x + 9, -24, kPi);
    buildings.PutUp(Buildings::House{
        .width_m = 9, .wall = x < 20 ? Buildings::Wall::kYellowPlaster : Buildings::Wall::kBrick});
  }
}

void Plant(Vegetation& plants) {
  plants.Hedge({-13.5F, -10.6F}, {28.2F, -10.6F}, 1.1F, 0.8F, {12.0F, 0.27F});
  plants.Hedge({-15, -9}, {-15, 17}, 1.4F, 0.9F, Vegetation::kAcross);
  for (const float y : {5.6F, 9.0F, 12.2F}) {
    plants.Stand(35.6F, y);
    if (y < 7.0F || y > 11.0F) plants.Tree(5.6F, 1.9F, {13.0F, 0.28F});
    if (y > 7.0F && y < 11.0F) plants.Bush(0.8F, 0.9F);
  }
  plants.Stand(15.9F, -6.4F);
  plants.Tree(5.0F, 1.7F, {13.0F, 0.28F});
  for (const float x : {-11.0F, -2.0F, 7.5F, 24.0F, 38.0F, 47.0F, 63.0F}) {
    plants.Stand(x, -13.6F);
    plants.Tree(7.5F + 0.03F * x, 2.8F, Vegetation::kAcross);
  }
  for (const float x : {-8.0F, 2.0F, 12.0F, 27.0F, 45.0F, 57.0F}) {
    plants.Stand(x, 20.4F, 0.1F);
    plants.Tree(6.2F, 2.1F, Vegetation::kAcross);
  }
  for (const float y : {-6.0F, 2.0F, 11.0F, 18.0F}) {
    plants.Stand(-21, y);
    plants.Tree(9.0F, 3.6F, Vegetation::kAcross);
  }
  plants.Stand(61.5F, 10.6F);
  plants.Tree(5.2F, 1.8F, {13.0F, 0.28F});
  for (const float x : {51.0F, 52.6F, 54.1F}) {
    plants.Stand(x, -0.1F);
    plants.Bush(0.75F, 0.9F);
  }
  plants.Stand(69.6F, -5.0F);
  plants.Conifer(7.0F, 2.0F);
  plants.Stand(70.2F, -12.0F);
  plants.Conifer(9.0F, 2.4F);
}

void SetOutFurniture(StreetFurniture& street) {
  for (const float x : {-3.4F, 11.6F, 26.6F}) {
    street.Stand(x, 9.0F);
    street.LampPost();
  }
  street.Stand(35.6F, 4.5F);
  street.LampPost();
  for (const float x : {15.9F, 40.0F, 55.0F}) {
    street.Stand(x, x < 20 ? -4.2F : -9.5F, kPi);
    street.LampPost();
  }
  for (const float x : {28.8F, 31.4F, 34.0F, 36.6F}) {
    street.Stand(x, -9.6F, kPi);
    street.Bollard();
  }
  street.Stand(34.9F, 7.4F, -0.6F);
  street.ParkingSign();
  street.Stand(3.6F, 9.0F);
  street.ParkingSign();
  street.Stand(36.2F, 7.4F);
  street.LitterBin();
  street.Stand(52.0F, 1.0F, kPi);
  street.ParkingSign();
  street.Stand(60.4F, 9.3F);
  street.LampPost();
  for (const float y : {3.0F, 4.4F, 5.8F}) {
    street.Stand(63.4F, y);
    street.Bollard();
  }
  street.Stand(66.9F, 9.2F, kSouth);
  street.Bench();
  street.Stand(66.9F, 11.2F, kSouth);
  street.LitterBin();
  street.StandAlong({28.6F, -10.4F}, {68, -10.4F});
  street.RailFence(39.4F, 1.1F);
  street.StandAlong({68.4F, -10.2F}, {68.4F, 12.0F});
  street.Railing(22.0F);
  for (const float x : {30.0F, 30.7F, 31.4F, 32.1F}) {
    street.Stand(x, 22.4F, kNorth + 0.1F, 0.115F);
    street.Bicycle();
  }
}

Result<Place> MakeLot(const std::string& name, Polyline points) {
  OutdoorKit kit(kSeed);
  LayGround(kit.paving);
  ParkCars(kit);
  PutUpBuildings(kit.buildings);
  Plant(kit.plants);
  SetOutFurniture(kit.street);
  kit.lighting.toward_sun = kSunBehind;
  return FinishOutdoors(kit, name, GroundMode::kFlat, std::move(points));
}

}  // namespace

Result<Place> MakePavedWorld() {
  return MakeLot("paved", {{0, -0.8}, {14, 0.6}, {26, -0.6}, {38, 1.0}, {48, 5.5}, {58, 7.5}});
}

Result<Place> MakeParkingPlaceWorld() {
  auto place = MakeLot("parking-place",
                       {{27.85, -7.4}, {27.85, -0.8}, {30.6, -0.2}, {31.6, -0.2}, {20.0, -0.2}});
  if (place) place->path.shunts_from = Gear::kBackwards;
  return place;
}

}  // namespace trailcast::sim
