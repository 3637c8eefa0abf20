#include <cmath>
#include <numbers>

#include "services/lab/sim/places/src/offices.h"
#include "services/lab/sim/places/src/rooms.h"

namespace trailcast::sim {
namespace {

using V2 = Eigen::Vector2f;
using Look = Rooms::Look;

constexpr std::uint64_t kCorridorSeed = 1975;
// The corridor's two straight parts and the place of the bend.
constexpr float kHalfWidth_m = 1.0F;
constexpr float kPlainFrom_m = 12.8F;
constexpr float kBend_m = 17.0F;
constexpr float kBend_rad = std::numbers::pi_v<float> / 6.0F;
constexpr float kPlainBeyond_m = 1.6F;
constexpr float kSecondPart_m = 15.5F;

V2 BeyondBend(float along_m, float left_m) {
  const V2 ahead(std::cos(kBend_rad), std::sin(kBend_rad));
  return V2(kBend_m, 0.0F) + along_m * ahead + left_m * V2(-ahead.y(), ahead.x());
}

void BuildFirstPart(Rooms& rooms) {
  const float mitre = kHalfWidth_m * std::tan(0.5F * kBend_rad);
  const float width = 2.0F * kHalfWidth_m;
  rooms.FloorAndCeiling({0, -kHalfWidth_m}, 0.0F, {kPlainFrom_m, width}, Look::kPatterned);
  rooms.FloorAndCeiling({kPlainFrom_m, -kHalfWidth_m}, 0.0F,
                        {kBend_m + mitre - kPlainFrom_m, width}, Look::kPlain);
  rooms.Wall({0, -kHalfWidth_m}, {0, kHalfWidth_m}, Look::kPatterned);
  const WallLine left =
      rooms.Wall({0, kHalfWidth_m}, {kPlainFrom_m, kHalfWidth_m}, Look::kPatterned);
  rooms.Fit(left, {{1.2F, Fitting::kDoor},
                   {2.8F, Fitting::kPoster},
                   {4.2F, Fitting::kCupboard},
                   {5.6F, Fitting::kDoor},
                   {7.2F, Fitting::kNotices},
                   {8.4F, Fitting::kBin},
                   {9.0F, Fitting::kDoor},
                   {10.6F, Fitting::kPoster},
                   {11.6F, Fitting::kPlant}});
  rooms.Wall({kPlainFrom_m, kHalfWidth_m}, {kBend_m - mitre, kHalfWidth_m}, Look::kPlain);
  const WallLine right =
      rooms.Wall({kPlainFrom_m, -kHalfWidth_m}, {0, -kHalfWidth_m}, Look::kPatterned);
  rooms.Fit(right, {{0.7F, Fitting::kPoster},
                    {2.2F, Fitting::kDoor},
                    {3.9F, Fitting::kPlant},
                    {5.2F, Fitting::kWhiteboard},
                    {7.6F, Fitting::kDoor},
                    {9.2F, Fitting::kPoster},
                    {10.2F, Fitting::kShelf}});
  rooms.Wall({kBend_m + mitre, -kHalfWidth_m}, {kPlainFrom_m, -kHalfWidth_m}, Look::kPlain);
  for (const float x : {1.8F, 4.8F, 7.8F, 10.8F}) rooms.CeilingLamp({x, 0}, 0.0F);
}

void BuildSecondPart(Rooms& rooms) {
  const float mitre = kHalfWidth_m * std::tan(0.5F * kBend_rad);
  const float width = 2.0F * kHalfWidth_m;
  const float end = kSecondPart_m;
  // It is a little lower where it goes under the first part's floor.
  rooms.FloorAndCeiling(BeyondBend(-mitre, -kHalfWidth_m), kBend_rad,
                        {kPlainBeyond_m + mitre, width}, Look::kPlain, -0.002F);
  rooms.FloorAndCeiling(BeyondBend(kPlainBeyond_m, -kHalfWidth_m), kBend_rad,
                        {end - kPlainBeyond_m, width}, Look::kPatterned);
  rooms.Wall(BeyondBend(mitre, kHalfWidth_m), BeyondBend(kPlainBeyond_m, kHalfWidth_m),
             Look::kPlain);
  const WallLine left = rooms.Wall(BeyondBend(kPlainBeyond_m, kHalfWidth_m),
                                   BeyondBend(end, kHalfWidth_m), Look::kPatterned);
  rooms.Fit(left, {{0.8F, Fitting::kDoor},
                   {2.6F, Fitting::kPoster},
                   {4.0F, Fitting::kShelf},
                   {5.6F, Fitting::kDoor},
                   {7.4F, Fitting::kPlant},
                   {8.4F, Fitting::kWhiteboard},
                   {10.6F, Fitting::kDoor},
                   {12.4F, Fitting::kPoster}});
  rooms.Wall(BeyondBend(kPlainBeyond_m, -kHalfWidth_m), BeyondBend(-mitre, -kHalfWidth_m),
             Look::kPlain);
  const WallLine right = rooms.Wall(BeyondBend(end, -kHalfWidth_m),
                                    BeyondBend(kPlainBeyond_m, -kHalfWidth_m), Look::kPatterned);
  rooms.Fit(right, {{1.0F, Fitting::kDoor},
                    {3.0F, Fitting::kPoster},
                    {4.4F, Fitting::kCupboard},
                    {6.0F, Fitting::kDoor},
                    {7.8F, Fitting::kNotices},
                    {9.2F, Fitting::kBin},
                    {10.2F, Fitting::kDoor},
                    {12.4F, Fitting::kPoster}});
  const WallLine last =
      rooms.Wall(BeyondBend(end, kHalfWidth_m), BeyondBend(end, -kHalfWidth_m), Look::kPatterned);
  rooms.Fit(last, {{0.3F, Fitting::kWindow}, {0.4F, Fitting::kRadiator}});
  for (const float s : {2.6F, 5.6F, 8.6F, 11.6F, 14.2F}) {
    rooms.CeilingLamp(BeyondBend(s, 0.0F), kBend_rad);
  }
}

}  // namespace

Result<Place> MakeCorridorWorld() {
  SceneBuilder builder;
  Furniture furniture(builder, kCorridorSeed);
  Rooms rooms(builder, furniture, kCorridorSeed);
  BuildFirstPart(rooms);
  BuildSecondPart(rooms);
  const V2 end = BeyondBend(13.6F, 0.0F);
  return FinishIndoors(builder.Take("corridor"), rooms.lamps(),
                       {{0.7, 0.0}, {kBend_m, 0.0}, {end.x(), end.y()}});
}

}  // namespace trailcast::sim
