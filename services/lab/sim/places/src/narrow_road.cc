#include "services/lab/sim/places/src/narrow_road.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/places/src/outdoor_kit.h"

namespace trailcast::sim {
namespace {

using V2 = Eigen::Vector2f;

constexpr std::uint64_t kNarrowRoadSeed = 1924;
constexpr float kRadius_m = 260.0F;  // the road bends to the left
constexpr float kFrom_m = -16.0F;
constexpr float kTo_m = 104.0F;
// These are places across the road, to the left of its middle.
constexpr float kKerb_m = 2.6F;
constexpr float kParkingEdge_m = 4.7F;
constexpr float kLeftFence_m = 6.3F;
constexpr float kLeftFronts_m = 8.2F;
constexpr float kRightFence_m = -4.2F;

// Returns a place by its distance along the road's middle and how far left of it is.
V2 OnRoad(float along_m, float left_m) {
  const float angle = along_m / kRadius_m;
  const float reach = kRadius_m - left_m;
  return {reach * std::sin(angle), kRadius_m - reach * std::cos(angle)};
}
float Heading(float along_m) { return along_m / kRadius_m; }

// Adds a ribbon of ground along the road between two distances from its middle.
void Ribbon(SceneBuilder& builder, MaterialId material, float left_from, float left_to, float z_m,
            float tile_m) {
  constexpr float kStep_m = 2.0F;
  builder.Place({0, 0, 0}, 0);
  for (float s = kFrom_m; s < kTo_m; s += kStep_m) {
    const auto corner = [&](float along_m, float left_m) -> Eigen::Vector3f {
      const V2 at = OnRoad(along_m, left_m);
      return {at.x(), at.y(), z_m};
    };
    builder.Quad(material,
                 {corner(s, left_to), corner(s, left_from), corner(s + kStep_m, left_from),
                  corner(s + kStep_m, left_to)},
                 {V2(s, -left_to) / tile_m, V2(s + kStep_m, -left_from) / tile_m});
  }
}

void LayRoad(OutdoorKit& kit) {
  Paving& paving = kit.paving;
  const auto slabs = kit.builder.AddMaterial("pavement", {255, 255, 255}, Slabs(kNarrowRoadSeed));
  paving.LawnGround({{-90, -80}, {170, 110}});
  Ribbon(kit.builder, paving.asphalt(), -kKerb_m - 0.1F, kParkingEdge_m + 0.1F, 0.004F, 4.0F);
  Ribbon(kit.builder, slabs, kParkingEdge_m, kLeftFence_m, 0.115F, 2.0F);
  Ribbon(kit.builder, slabs, kRightFence_m, -kKerb_m - 0.1F, 0.115F, 2.0F);
  constexpr float kSpan_m = 6.0F;
  for (float s = kFrom_m; s < kTo_m; s += kSpan_m) {
    paving.Kerb(OnRoad(s, kParkingEdge_m), OnRoad(s + kSpan_m, kParkingEdge_m));
    paving.Kerb(OnRoad(s, -kKerb_m - 0.1F), OnRoad(s + kSpan_m, -kKerb_m - 0.1F));
    paving.Line(OnRoad(s, kKerb_m), OnRoad(s + 0.6F * kSpan_m, kKerb_m));
    paving.Line(OnRoad(s, 0.3F), OnRoad(s + 1.6F, 0.3F));
  }
  Random random(kNarrowRoadSeed, "wear");
  for (float s = -10.0F; s < 96.0F; s += 1.6F) {
    const auto left = static_cast<float>(random.Uniform(-2.0, 2.2));
    paving.WearSpot(OnRoad(s, left), Heading(s), 0.9F);
  }
}

// Builds a terrace of equal houses with equal windows.
void Terrace(Buildings& buildings, float from_m, int houses, float left_m, Buildings::Wall wall) {
  constexpr float kWide_m = 7.0F;
  for (int i = 0; i < houses; ++i) {
    const bool on_left = left_m > 0.0F;
    const float s = from_m + kWide_m * static_cast<float>(i + (on_left ? 0 : 1));
    const V2 corner = OnRoad(s, left_m);
    const float middle = from_m + kWide_m * (static_cast<float>(i) + 0.5F);
    buildings.Stand(corner.x(), corner.y(), Heading(middle) + (on_left ? 0.0F : kPi));
    buildings.PutUp(
        Buildings::House{.width_m = kWide_m, .depth_m = 8, .wall = wall, .alike = true});
  }
}

void PutUpHouses(Buildings& buildings) {
  Terrace(buildings, -14, 7, kLeftFronts_m, Buildings::Wall::kBrick);
  Terrace(buildings, 44, 7, kLeftFronts_m, Buildings::Wall::kWhitePlaster);
  Terrace(buildings, 52, 4, kRightFence_m, Buildings::Wall::kDarkBrick);
  for (const float s : {2.0F, 16.0F, 33.0F, 92.0F}) {
    const V2 corner = OnRoad(s + 9.0F, -11.0F);
    buildings.Stand(corner.x(), corner.y(), Heading(s) + kPi);
    buildings.PutUp(Buildings::House{
        .width_m = 9, .wall = Buildings::Wall::kYellowPlaster, .garage = s > 20.0F});
  }
  const V2 end = OnRoad(112, 8);
  buildings.Stand(end.x(), end.y(), Heading(112) - kPi / 2.0F);
  buildings.PutUp(
      Buildings::Block{.width_m = 22, .storeys = 3, .wall = Buildings::Wall::kConcrete});
}

// Builds sections of fence by `build(length)`, in pieces that follow the bend.
template <typename Build>
void Fence(StreetFurniture& street, float from_m, float to_m, float left_m, const Build& build) {
  constexpr float kPiece_m = 4.2F;
  for (float s = from_m; s < to_m - 0.1F; s += kPiece_m) {
    const float next = std::min(s + kPiece_m, to_m);
    // The right side's fences face the other way, so that the road sees their fronts.
    build(left_m > 0.0F ? street.StandAlong(OnRoad(s, left_m), OnRoad(next, left_m))
                        : street.StandAlong(OnRoad(next, left_m), OnRoad(s, left_m)));
  }
}

void PutUpFences(OutdoorKit& kit) {
  StreetFurniture& street = kit.street;
  const auto pickets = [&](float length) { street.PicketFence(length); };
  const auto boards = [&](float length) { street.BoardFence(length, 1.6F); };
  const auto wall = [&](float length) { street.GardenWall(length); };
  const auto railing = [&](float length) { street.Railing(length, 1.1F); };
  Fence(street, -14, 12, kLeftFence_m, railing);
  Fence(street, 12, 35, kLeftFence_m, wall);
  Fence(street, 44, 66, kLeftFence_m, pickets);
  Fence(street, 66, 93, kLeftFence_m, railing);
  Fence(street, 9, 27, kRightFence_m - 0.1F, pickets);
  Fence(street, 27, 41, kRightFence_m - 0.1F, boards);
  Fence(street, 41, 52, kRightFence_m - 0.1F, wall);
  Fence(street, 80, 100, kRightFence_m - 0.1F, boards);
  for (float s = -14.0F; s < 8.0F; s += 5.5F) {
    kit.plants.Hedge(OnRoad(s, kRightFence_m - 0.5F), OnRoad(s + 5.5F, kRightFence_m - 0.5F), 1.5F,
                     0.9F, {14.0F, 0.25F});
  }
  kit.plants.Hedge(OnRoad(36, kLeftFence_m + 0.5F), OnRoad(43, kLeftFence_m + 0.5F), 1.7F, 0.8F,
                   {14.0F, 0.25F});
}

void ParkAndPlant(OutdoorKit& kit) {
  for (const float s : {-8.0F, 6.5F, 12.5F, 29.0F, 34.4F, 47.0F, 59.5F, 65.2F, 78.0F, 90.0F}) {
    const V2 at = OnRoad(s, 3.65F);
    kit.vehicles.ParkAny(at.x(), at.y(), Heading(s) + (s > 40.0F ? kPi : 0.0F));
  }
  for (const float s : {4.0F, 15.0F, 24.0F, 38.0F, 47.5F, 86.0F, 95.0F}) {
    const V2 at = OnRoad(s, -7.4F - 0.02F * s);
    kit.plants.Stand(at.x(), at.y());
    kit.plants.Tree(5.0F + 0.02F * s, 1.9F, {9.0F, 0.34F});
  }
  for (const float s : {19.0F, 40.0F, 72.0F}) {
    const V2 at = OnRoad(s, 3.9F);
    kit.plants.Stand(at.x(), at.y());
    kit.plants.Tree(5.2F, 1.6F, {14.0F, 0.27F});
  }
  for (const float s : {3.0F, 25.0F, 47.0F, 69.0F, 91.0F}) {
    const V2 at = OnRoad(s, -3.9F);
    kit.street.Stand(at.x(), at.y(), Heading(s) + kPi, 0.1F);
    kit.street.LampPost();
  }
  for (const float s : {14.0F, 55.0F, 82.0F}) {
    const V2 at = OnRoad(s, -3.5F);
    kit.street.Stand(at.x(), at.y(), Heading(s) - kPi / 2.0F, 0.1F);
    kit.street.SpeedSign();
    const V2 bin = OnRoad(s + 4.0F, -3.8F);
    kit.street.Stand(bin.x(), bin.y(), Heading(s) + kPi, 0.1F);
    kit.street.LitterBin();
  }
}

}  // namespace

Result<Place> MakeRoadWorld() {
  OutdoorKit kit(kNarrowRoadSeed);
  LayRoad(kit);
  PutUpHouses(kit.buildings);
  PutUpFences(kit);
  ParkAndPlant(kit);
  kit.lighting.toward_sun = kSunBehind;
  Polyline way;
  for (int i = 0; i <= 10; ++i) {
    const float left = -0.9F + (i % 2 == 0 ? 0.15F : -0.15F);
    way.push_back(OnRoad(8.0F * static_cast<float>(i), left).cast<double>());
  }
  return FinishOutdoors(kit, "road", GroundMode::kFlat, std::move(way));
}

}  // namespace trailcast::sim
