#include "services/lab/sim/places/src/offices.h"

#include <tuple>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/places/src/rooms.h"

namespace trailcast::sim {
namespace {

using V2 = Eigen::Vector2f;

constexpr std::uint64_t kSeed = 1973;
// The direction in which the front of a piece of furniture looks.
constexpr float kSouth = 0.0F;
constexpr float kEast = kPi / 2.0F;
constexpr float kNorth = kPi;
constexpr float kWest = -kPi / 2.0F;

using Look = Rooms::Look;

void DeskWithThings(Furniture& f, float x, float y, float yaw_rad, float width = 1.6F) {
  f.Stand(x, y, yaw_rad);
  f.Desk(width, 0.75F);
  f.DeskThings(width, 0.75F);
}

// The corridor of `turns` goes east, north, west, then through a passage to the room in the north.
void BuildTurningCorridor(Rooms& rooms) {
  rooms.FloorAndCeiling({0.2F, 0.5F}, 0.0F, {7.3F, 2.0F}, Look::kPatterned);
  rooms.FloorAndCeiling({5.6F, 2.5F}, 0.0F, {1.9F, 3.9F}, Look::kPatterned);
  rooms.FloorAndCeiling({1.1F, 4.5F}, 0.0F, {4.5F, 1.9F}, Look::kPatterned);
  const WallLine south = rooms.Wall({7.5F, 0.5F}, {0.2F, 0.5F}, Look::kPatterned);
  rooms.Fit(south, {{1.7F, Fitting::kDoor},
                    {3.4F, Fitting::kPoster},
                    {4.6F, Fitting::kDoor},
                    {6.3F, Fitting::kPlant}});
  const WallLine inner = rooms.Wall({0.2F, 2.5F}, {5.6F, 2.5F}, Look::kPatterned);
  rooms.Fit(inner,
            {{0.5F, Fitting::kCupboard}, {1.8F, Fitting::kWhiteboard}, {4.2F, Fitting::kDoor}});
  rooms.Wall({0.2F, 0.5F}, {0.2F, 2.5F}, Look::kPatterned);
  const WallLine east = rooms.Wall({7.5F, 6.4F}, {7.5F, 0.5F}, Look::kPatterned);
  rooms.Fit(east, {{1.6F, Fitting::kWindow}, {4.5F, Fitting::kPoster}});
  rooms.Wall({5.6F, 2.5F}, {5.6F, 4.5F}, Look::kPlain);
  rooms.Wall({5.6F, 4.5F}, {1.1F, 4.5F}, Look::kPlain);
  const WallLine west = rooms.Wall({1.1F, 4.5F}, {1.1F, 6.4F}, Look::kPatterned);
  rooms.Fit(west, {{0.6F, Fitting::kPoster}});
  const WallLine north = rooms.Wall({2.95F, 6.4F}, {7.5F, 6.4F}, Look::kPatterned);
  rooms.Fit(north, {{0.4F, Fitting::kNotices}, {1.5F, Fitting::kDoor}, {3.7F, Fitting::kPoster}});
  for (const V2& at :
       {V2(1.5F, 1.5F), V2(4.6F, 1.5F), V2(6.5F, 3.4F), V2(6.3F, 5.5F), V2(3.0F, 5.5F)}) {
    rooms.CeilingLamp(at, 0.0F);
  }
}

void BuildNorthRoom(Rooms& rooms, Furniture& f) {
  rooms.FloorAndCeiling({0.2F, 6.4F}, 0.0F, {8.4F, 6.0F}, Look::kPatterned);
  rooms.Wall({1.1F, 6.52F}, {0.2F, 6.52F}, Look::kPatterned);
  const WallLine south = rooms.Wall({8.6F, 6.52F}, {2.95F, 6.52F}, Look::kPatterned);
  rooms.Fit(south, {{0.3F, Fitting::kShelf}, {3.3F, Fitting::kPoster}, {4.4F, Fitting::kPoster}});
  rooms.Lintel({1.1F, 6.4F}, {2.95F, 6.4F});
  const WallLine west = rooms.Wall({0.2F, 6.52F}, {0.2F, 12.4F}, Look::kPatterned);
  rooms.Fit(west,
            {{1.0F, Fitting::kPoster}, {2.4F, Fitting::kShelf}, {4.2F, Fitting::kWhiteboard}});
  const WallLine north = rooms.Wall({0.2F, 12.4F}, {8.6F, 12.4F}, Look::kPatterned);
  rooms.Fit(north, {{0.6F, Fitting::kWindow},
                    {0.7F, Fitting::kRadiator},
                    {2.8F, Fitting::kWindow},
                    {5.0F, Fitting::kShelf},
                    {6.3F, Fitting::kPoster},
                    {7.4F, Fitting::kPlant}});
  const WallLine east = rooms.Wall({8.6F, 12.4F}, {8.6F, 6.52F}, Look::kPatterned);
  rooms.Fit(east, {{0.6F, Fitting::kDoor}, {2.2F, Fitting::kPoster}, {4.7F, Fitting::kCupboard}});
  DeskWithThings(f, 2.9F, 11.6F, kSouth);
  f.Stand(4.9F, 11.4F, 0.6F);
  f.Chair();
  DeskWithThings(f, 7.75F, 9.6F, kWest, 1.4F);
  f.Stand(7.2F, 10.4F, kWest);
  f.Chair();
  f.Stand(0.9F, 11.5F, kSouth);
  f.Cartons(3);
  for (const V2& at : {V2(2.2F, 8.2F), V2(6.4F, 8.2F), V2(2.2F, 10.8F), V2(6.4F, 10.8F)}) {
    rooms.CeilingLamp(at, 0.0F);
  }
}

void BuildDeskRoom(Rooms& rooms) {
  constexpr float kLength_m = 9.2F;
  constexpr float kWidth_m = 7.4F;
  rooms.FloorAndCeiling({0, 0}, 0.0F, {kLength_m, kWidth_m}, Look::kPatterned);
  const WallLine south = rooms.Wall({kLength_m, 0}, {0, 0}, Look::kPatterned);
  rooms.Fit(south, {{0.8F, Fitting::kPoster},
                    {2.0F, Fitting::kPoster},
                    {3.4F, Fitting::kWhiteboard},
                    {5.6F, Fitting::kNotices},
                    {7.4F, Fitting::kDoor}});
  const WallLine north = rooms.Wall({0, kWidth_m}, {kLength_m, kWidth_m}, Look::kPatterned);
  rooms.Fit(north, {{0.8F, Fitting::kWindow},
                    {0.9F, Fitting::kRadiator},
                    {3.0F, Fitting::kWindow},
                    {3.1F, Fitting::kRadiator},
                    {5.2F, Fitting::kShelf},
                    {6.9F, Fitting::kDoor},
                    {8.4F, Fitting::kPoster}});
  const WallLine east = rooms.Wall({kLength_m, kWidth_m}, {kLength_m, 0}, Look::kPatterned);
  rooms.Fit(east, {{1.0F, Fitting::kPoster}, {2.3F, Fitting::kPoster}, {5.6F, Fitting::kCupboard}});
  const WallLine west = rooms.Wall({0, 0}, {0, kWidth_m}, Look::kPatterned);
  rooms.Fit(west, {{0.8F, Fitting::kShelf}, {2.6F, Fitting::kDoor}, {5.0F, Fitting::kWhiteboard}});
  for (const float y : {1.5F, 3.7F, 5.9F}) {
    for (const float x : {1.6F, 4.6F, 7.6F}) rooms.CeilingLamp({x, y}, 0.0F);
  }
}

// Chairs are drawn out a little, with their backs to the path.
void FurnishDeskRoom(Furniture& f) {
  DeskWithThings(f, 2.3F, 2.72F, kNorth);  // along the way in
  DeskWithThings(f, 0.6F, 1.2F, kSouth, 1.4F);
  DeskWithThings(f, 0.5F, 4.05F, kSouth);
  DeskWithThings(f, 2.2F, 4.05F, kSouth);
  DeskWithThings(f, 2.1F, 5.6F, kNorth);
  DeskWithThings(f, 3.8F, 5.6F, kNorth);
  DeskWithThings(f, 5.2F, 1.55F, kNorth);  // along the way to the east
  DeskWithThings(f, 7.0F, 1.55F, kNorth);
  DeskWithThings(f, 4.58F, 2.85F, kSouth);
  DeskWithThings(f, 6.8F, 4.5F, kEast);  // on either side of the last section
  DeskWithThings(f, 8.05F, 4.3F, kWest);
  DeskWithThings(f, 8.05F, 6.1F, kWest);
  f.Stand(6.1F, 3.75F, kSouth);
  f.Cupboard(0.7F, 1.2F, 0.45F);
  for (const auto& [x, y, yaw] :
       {std::tuple{1.5F, 2.50F, kSouth + 0.2F}, std::tuple{1.3F, 4.25F, kNorth - 0.2F},
        std::tuple{4.3F, 3.55F, 0.5F}, std::tuple{3.4F, 1.8F, 2.4F},
        std::tuple{5.6F, 1.32F, kSouth}, std::tuple{5.3F, 3.10F, kNorth + 0.15F},
        std::tuple{6.55F, 5.3F, kWest}, std::tuple{8.27F, 5.3F, kEast},
        std::tuple{8.4F, 2.2F, -1.2F}}) {
    f.Stand(x, y, yaw);
    f.Chair();
  }
  f.Stand(8.75F, 2.45F, kSouth);
  f.Bin();
  f.Stand(3.0F, 0.9F, kSouth);
  f.Cartons(2);
}

}  // namespace

Result<Place> MakeTurnsWorld() {
  SceneBuilder builder;
  Furniture furniture(builder, kSeed);
  Rooms rooms(builder, furniture, kSeed);
  BuildTurningCorridor(rooms);
  BuildNorthRoom(rooms, furniture);
  return FinishIndoors(
      builder.Take("turns"), rooms.lamps(),
      {{1.3, 1.5}, {6.5, 1.5}, {6.5, 5.45}, {2.0, 5.45}, {2.0, 10.4}, {6.0, 7.7}, {6.0, 11.2}});
}

Result<Place> MakeDesksWorld() {
  SceneBuilder builder;
  Furniture furniture(builder, kSeed + 1);
  Rooms rooms(builder, furniture, kSeed + 1);
  BuildDeskRoom(rooms);
  FurnishDeskRoom(furniture);
  return FinishIndoors(builder.Take("desks"), rooms.lamps(),
                       {{0.9, 3.4}, {3.2, 3.4}, {4.2, 2.2}, {6.4, 2.2}, {7.4, 3.6}, {7.4, 6.0}});
}

}  // namespace trailcast::sim
