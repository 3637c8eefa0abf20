#include "services/lab/sim/places/indoor_world.h"

#include <numbers>
#include <utility>

#include "services/lab/sim/core/light_bake.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/furniture.h"
#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/places/src/rooms.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kIndoorSeed = 2009;
constexpr float kLength_m = 12.0F;  // along x
constexpr float kWidth_m = 9.0F;    // along y
constexpr float kHeight_m = 2.8F;
// The wall between the rooms, and the doorway in it.
constexpr float kPartition_m = 4.35F;
constexpr float kDoorFrom_m = 6.2F;
constexpr float kDoorTo_m = 8.3F;

// The direction in which the front of a piece of furniture looks.
constexpr float kSouth = 0.0F;
constexpr float kEast = std::numbers::pi_v<float> / 2.0F;
constexpr float kNorth = std::numbers::pi_v<float>;
constexpr float kWest = -std::numbers::pi_v<float> / 2.0F;

constexpr double kNightLamp = 2.6;  // light a metre before one that is left on
constexpr float kAmbient = 0.55F;
constexpr float kNightAmbient = 0.18F;

const Eigen::Vector3f kWhite = {255.0F, 255.0F, 255.0F};

void AddShell(SceneBuilder& b) {
  const auto boards = b.AddMaterial("floor boards", kWhite, FloorBoards(kIndoorSeed));
  const auto carpet = b.AddMaterial("carpet", kWhite, CarpetTiles({98, 106, 118}, kIndoorSeed));
  const auto plaster = b.AddMaterial("plaster", kWhite, Plaster({206, 204, 196}, kIndoorSeed));
  const auto green = b.AddMaterial("green plaster", kWhite, Plaster({168, 186, 172}, kIndoorSeed));
  const auto brick = b.AddMaterial("bricks", kWhite, Brickwork(kIndoorSeed));
  const auto ceiling = b.AddMaterial("ceiling", kWhite, CeilingTiles(kIndoorSeed));
  const auto skirting = b.AddMaterial("skirting", {92, 84, 76});
  const Eigen::Vector3f down(0, 0, -kHeight_m);
  const auto tiled = [](float width, float height, float tile) {
    return TexturePart{{0, 0}, {width / tile, height / tile}};
  };
  b.Place({0, 0, 0}, 0);
  b.Panel(boards, {0, kPartition_m, 0}, {kLength_m, 0, 0}, {0, -kPartition_m, 0},
          tiled(kLength_m, kPartition_m, 2.4F));
  b.Panel(carpet, {0, kWidth_m, 0}, {kLength_m, 0, 0}, {0, kPartition_m - kWidth_m, 0},
          tiled(kLength_m, kWidth_m - kPartition_m, 1.0F));
  b.Panel(ceiling, {0, 0, kHeight_m}, {kLength_m, 0, 0}, {0, kWidth_m, 0},
          tiled(kLength_m, kWidth_m, 1.2F));
  b.Panel(plaster, {0, kWidth_m, kHeight_m}, {kLength_m, 0, 0}, down,
          tiled(kLength_m, kHeight_m, 3));
  b.Panel(brick, {kLength_m, kWidth_m, kHeight_m}, {0, -kWidth_m, 0}, down,
          tiled(kWidth_m, kHeight_m, 1.5F));
  b.Panel(plaster, {kLength_m, 0, kHeight_m}, {-kLength_m, 0, 0}, down,
          tiled(kLength_m, kHeight_m, 3));
  b.Panel(green, {0, 0, kHeight_m}, {0, kWidth_m, 0}, down, tiled(kWidth_m, kHeight_m, 3));
  b.Box(green, {0, kPartition_m, 0}, {kDoorFrom_m, kPartition_m + 0.12F, kHeight_m}, 3);
  b.Box(green, {kDoorTo_m, kPartition_m, 0}, {kLength_m, kPartition_m + 0.12F, kHeight_m}, 3);
  b.Box(green, {kDoorFrom_m, kPartition_m, 2.2F}, {kDoorTo_m, kPartition_m + 0.12F, kHeight_m}, 3);
  // The wall's inside shows only where a plan cuts it open.
  for (const auto& [from, to] : {std::pair{0.0F, kDoorFrom_m}, std::pair{kDoorTo_m, kLength_m}}) {
    b.Panel(skirting, {from, kPartition_m + 0.12F, 1.5F}, {to - from, 0, 0}, {0, -0.12F, 0});
  }
  b.Box(skirting, {0, 0, 0}, {kLength_m, 0.015F, 0.08F});
  b.Box(skirting, {0, kWidth_m - 0.015F, 0}, {kLength_m, kWidth_m, 0.08F});
  b.Box(skirting, {kLength_m - 0.015F, 0, 0}, {kLength_m, kWidth_m, 0.08F});
  b.Box(skirting, {0, 0, 0}, {0.015F, kWidth_m, 0.08F});
  for (const float x : {kDoorFrom_m, kDoorTo_m - 0.06F}) {
    b.Box(skirting, {x, kPartition_m - 0.03F, 0}, {x + 0.06F, kPartition_m + 0.15F, 2.2F});
  }
}

// Ceiling panels in two rows a room, and the windows, give the light. At night both are almost
// dark, and some lamps are on, at the height of desks and shelves.
std::vector<Lamp> AddLamps(SceneBuilder& b, double night) {
  const auto glow = b.AddMaterial("lamp", {250, 250, 246}, nullptr, true);
  const auto frame = b.AddMaterial("lamp frame", {190, 190, 190});
  std::vector<Lamp> lamps;
  b.Place({0, 0, 0}, 0);
  for (const float y : {1.4F, 3.3F, 5.8F, 7.9F}) {
    for (const float x : {1.8F, 4.6F, 7.4F, 10.2F}) {
      const float z = kHeight_m - 0.06F;
      b.Box(frame, {x - 0.62F, y - 0.17F, z}, {x + 0.62F, y + 0.17F, kHeight_m});
      b.Panel(glow, {x - 0.6F, y - 0.15F, z - 0.004F}, {1.2F, 0, 0}, {0, 0.3F, 0});
      lamps.push_back({{x, y, z - 0.06F}, -Eigen::Vector3f::UnitZ(), 1.6F});
    }
  }
  for (const float x : {2.0F, 5.6F, 9.2F}) {
    lamps.push_back({{x, 0.2F, 1.6F}, Eigen::Vector3f::UnitY(), 1.3F});
  }
  if (night == 0.0) return lamps;
  for (Lamp& lamp : lamps) lamp.strength *= static_cast<float>(1.0 - 0.95 * night);
  const auto lit = [&](const Eigen::Vector3f& at, const Eigen::Vector3f& towards) {
    lamps.push_back({at, towards.normalized(), static_cast<float>(kNightLamp * night)});
  };
  lit({2.2F, 3.2F, 1.3F}, {1.0F, -0.6F, 0.0F});
  lit({11.4F, 0.5F, 1.9F}, {-1.0F, 0.6F, -0.2F});
  lit({8.6F, 4.0F, 1.6F}, {-0.4F, -1.0F, 0.0F});
  lit({11.5F, 6.8F, 1.4F}, {-1.0F, 0.1F, 0.0F});
  lit({5.2F, 8.6F, 1.9F}, {0.3F, -1.0F, -0.2F});
  lit({0.5F, 5.6F, 1.5F}, {1.0F, 0.5F, 0.0F});
  return lamps;
}

// The south room has desks under the windows, an island of desks, and shelves and tall things along
// the east.
void FurnishSouthRoom(Furniture& f, SceneBuilder& b) {
  for (const float x : {2.7F, 6.3F, 9.9F}) {
    f.Build(x, 0.0F, kNorth, 1.0F);
    f.Window(1.5F, 1.3F);
    f.Build(x, 0.0F, kNorth);
    f.Radiator(1.5F);
  }
  for (const float x : {1.7F, 3.5F, 5.4F}) {
    f.Stand(x, 0.72F, kNorth);
    f.Desk(1.6F, 0.68F);
    f.DeskThings(1.6F, 0.68F);
  }
  for (const float x : {1.5F, 3.2F}) {
    f.Stand(x, 2.45F, kSouth);
    f.Desk(1.6F, 0.75F);
    f.DeskThings(1.6F, 0.75F);
    f.Stand(x + 1.6F, 3.97F, kNorth);
    f.Desk(1.6F, 0.75F);
    f.DeskThings(1.6F, 0.75F);
  }
  f.Stand(5.35F, 3.0F, 0.6F);
  f.Chair();
  f.Stand(6.45F, 0.42F, 0.4F);
  f.Bin();
  f.Stand(7.0F, 0.75F, kNorth);
  f.Cupboard(0.9F, 1.6F, 0.45F);
  f.Stand(8.75F, 0.8F, kNorth);
  f.LabBench(1.55F, 0.72F);
  f.Stand(10.6F, 0.8F, kNorth);
  f.LabBench(1.6F, 0.72F);
  f.Stand(kLength_m - 0.34F, 3.9F, kWest);
  f.Shelf(1.2F, 2.1F, 0.32F, 6);
  f.Stand(kLength_m - 0.34F, 2.6F, kWest);
  f.Shelf(1.2F, 1.8F, 0.32F, 5);
  f.Stand(9.9F, 2.6F, 0.0F);
  f.RoundTable();
  f.Stand(9.2F, 2.55F, kEast + 0.3F);
  f.Chair();
  f.Stand(10.6F, 2.9F, kWest - 0.2F);
  f.Chair();
  f.Stand(8.75F, kPartition_m, kSouth);
  f.Plant();
  f.Stand(9.3F, kPartition_m - 0.42F, kSouth);
  f.Cartons(3);
  f.Stand(10.4F, kPartition_m, kSouth, 1.15F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Stand(1.2F, kPartition_m, kSouth, 1.15F);
  f.Hang(f.whiteboard(), 1.8F, 1.0F);
  f.Stand(4.6F, kPartition_m, kSouth, 1.2F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Stand(5.45F, kPartition_m, kSouth, 1.3F);
  f.Hang(f.page(), 0.3F, 0.42F);
  f.Stand(kLength_m, 1.3F, kWest, 1.3F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Build(0.0F, 1.1F, kEast);
  f.Door(b.AddMaterial("door", kWhite, DoorLeaf("EXIT")));
  f.Stand(0.0F, 2.9F, kEast, 1.2F);
  f.Hang(f.poster(), 0.6F, 0.85F);
}

// The north room has a bench along the wall, an island, and, at the path's end, a wall of shelves
// and a door.
void FurnishNorthRoom(Furniture& f, SceneBuilder& b) {
  for (const float x : {2.3F, 4.3F, 8.9F}) {
    f.Stand(x, kWidth_m - 0.74F, kSouth);
    f.LabBench(1.9F, 0.72F);
  }
  for (const float x : {2.6F, 3.5F, 6.5F, 9.3F}) {
    f.Stand(x, kWidth_m, kSouth, 1.35F);
    f.Hang(f.poster(), 0.62F, 0.88F);
  }
  f.Stand(4.6F, kWidth_m, kSouth, 1.35F);
  f.Hang(f.whiteboard(), 1.5F, 0.85F);
  f.Stand(6.4F, kWidth_m - 0.46F, kSouth);
  f.Cupboard(0.9F, 1.25F, 0.45F);
  f.Stand(7.5F, kWidth_m - 0.34F, kSouth);
  f.Shelf(1.2F, 2.1F, 0.32F, 6);
  f.Stand(kLength_m - 0.36F, 8.6F, kWest);
  f.Shelf(1.3F, 2.0F, 0.34F, 6);
  f.Stand(kLength_m - 0.36F, 7.2F, kWest);
  f.Shelf(1.3F, 2.0F, 0.34F, 5);
  f.Stand(kLength_m - 0.74F, 5.75F, kWest);
  f.Desk(1.2F, 0.72F);
  f.DeskThings(1.2F, 0.72F);
  f.Stand(9.2F, 6.1F, kWest);
  f.Desk(1.4F, 0.75F);
  f.DeskThings(1.4F, 0.75F);
  f.Stand(9.55F, 7.3F, 2.5F);
  f.Chair();
  for (const float x : {1.4F, 3.1F}) {
    f.Stand(x + 1.6F, 5.95F, kNorth);
    f.Desk(1.6F, 0.75F);
    f.DeskThings(1.6F, 0.75F);
  }
  f.Stand(4.95F, 5.2F, kNorth + 0.4F);
  f.Chair();
  f.Stand(5.45F, kPartition_m + 0.12F + 0.34F, kNorth);
  f.Shelf(1.2F, 1.9F, 0.32F, 5);
  f.Stand(3.9F, kPartition_m + 0.12F, kNorth, 1.15F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Stand(11.0F, kPartition_m + 0.12F, kNorth, 1.15F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Stand(0.35F, 8.5F, kSouth);
  f.Plant();
  f.Build(0.0F, 6.55F, kEast);
  f.Door(b.AddMaterial("door", kWhite, DoorLeaf("LAB 2")));
  f.Stand(0.36F, 5.0F, kEast);
  f.Shelf(1.3F, 2.0F, 0.34F, 6);
  f.Stand(0.0F, 7.8F, kEast, 1.25F);
  f.Hang(f.poster(), 0.6F, 0.85F);
  f.Stand(1.0F, 8.45F, 0.0F);
  f.Cartons(2);
}

Result<Place> MakeLaboratory(const std::string& name, Polyline points, const PlaceChange& change) {
  SceneBuilder builder;
  AddShell(builder);
  const std::vector<Lamp> lamps = AddLamps(builder, change.night);
  Furniture furniture(builder, kIndoorSeed);
  furniture.MoveSome(change.moved, change.seed);
  FurnishSouthRoom(furniture, builder);
  FurnishNorthRoom(furniture, builder);
  Scene scene = builder.Take(name);
  ChangeTextures(change.textures, change.seed, scene);
  const auto night = static_cast<float>(change.night);
  for (Material& material : scene.materials) {
    if (material.name == "lamp" || material.name == "window view") {
      material.color *= 1.0F - 0.9F * night;
    }
  }
  return FinishIndoors(std::move(scene), lamps, std::move(points),
                       kAmbient + night * (kNightAmbient - kAmbient));
}

}  // namespace

Result<Place> MakeIndoorWorld() { return MakeIndoorWorld(PlaceChange{}); }

Result<Place> MakeIndoorWorld(const PlaceChange& change) {
  return MakeLaboratory(
      "indoor", {{1.0, 1.5}, {6.0, 1.5}, {7.2, 3.2}, {7.2, 5.6}, {5.8, 7.0}, {2.3, 7.0}}, change);
}

Result<Place> MakeDeadEndWorld() {
  return MakeLaboratory("dead-end",
                        {{7.2, 3.2},
                         {7.2, 5.6},
                         {5.8, 7.0},
                         {2.3, 7.0},
                         {5.8, 7.0},
                         {7.2, 5.6},
                         {7.2, 3.2},
                         {6.0, 1.5}},
                        {});
}

}  // namespace trailcast::sim
