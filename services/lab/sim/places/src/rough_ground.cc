#include "services/lab/sim/places/src/rough_ground.h"

#include <cmath>
#include <utility>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/looks/outdoor_textures.h"
#include "services/lab/sim/looks/terrain.h"
#include "services/lab/sim/places/src/outdoor_kit.h"

namespace trailcast::sim {
namespace {

constexpr std::uint64_t kRoughGroundSeed = 1887;
constexpr double kRoughSlip = 0.05;
// Grass and stones that a wheel would feel stay so far from the path.
constexpr double kClear_m = 0.75;

const Polyline& WayPoints() {
  static const Polyline points = {{0, 0}, {9, 1.8}, {18, -0.6}, {28, -2.2}, {39, 1.0}};
  return points;
}

class RoughGround {
 public:
  RoughGround() : terrain_({{14.0F, 0.06F}, {3.4F, 0.019F}, {1.1F, 0.0030F}}, kRoughGroundSeed) {}

  Result<Place> Make() {
    AddGround();
    ScatterStones();
    ScatterTussocks();
    Plant();
    PutUpThings();
    kit_.lighting.toward_sun = kSunBehind;
    auto place = FinishOutdoors(kit_, "rough", GroundMode::kMesh, WayPoints());
    if (place) place->slip = kRoughSlip;
    return place;
  }

 private:
  [[nodiscard]] float Height(float x, float y) const { return terrain_.Height(x, y); }
  [[nodiscard]] float Between(double low, double high) {
    return static_cast<float>(random_.Uniform(low, high));
  }
  // Returns a place within reach of the path, but not on it.
  Eigen::Vector2f BesideTheWay(double reach_m) {
    while (true) {
      const Eigen::Vector2d at(random_.Uniform(-3.0, 46.0), random_.Uniform(-reach_m, reach_m));
      if (Nearest(WayPoints(), at).distance_m > kClear_m) return at.cast<float>();
    }
  }

  void AddGround();
  void ScatterStones();
  void ScatterTussocks();
  void Plant();
  void PutUpThings();

  OutdoorKit kit_{kRoughGroundSeed};
  Terrain terrain_;
  Random random_{kRoughGroundSeed, "rough"};
};

void RoughGround::AddGround() {
  const auto meadow = kit_.builder.AddMaterial("meadow", {255, 255, 255}, Meadow(kRoughGroundSeed));
  kit_.builder.Place({0, 0, 0}, 0);
  AddHeightField(kit_.builder, meadow, {-40, -2, 42, 100, 0.22F}, {-60, -4.2F, 4.2F, 60, 0.22F},
                 3.0F, [this](float x, float y) { return Height(x, y); });
}

void RoughGround::ScatterStones() {
  const auto stone = kit_.builder.AddMaterial("stone", {255, 255, 255}, Stone(kRoughGroundSeed));
  for (int i = 0; i < 150; ++i) {
    const Eigen::Vector2f at = BesideTheWay(7.0);
    const float size = Between(0.05, 0.22);
    kit_.builder.Place({at.x(), at.y(), Height(at.x(), at.y())}, Between(0.0, 6.28));
    AddBoulder(kit_.builder, stone, size, random_);
  }
}

void RoughGround::ScatterTussocks() {
  for (int i = 0; i < 520; ++i) {
    const Eigen::Vector2f at = BesideTheWay(i < 380 ? 5.0 : 12.0);
    kit_.plants.Stand(at.x(), at.y(), Height(at.x(), at.y()));
    kit_.plants.Tussock(Between(0.10, 0.26), Between(0.10, 0.34));
  }
}

void RoughGround::Plant() {
  Vegetation& plants = kit_.plants;
  const auto stand = [&](float x, float y) { plants.Stand(x, y, Height(x, y) - 0.05F); };
  for (const auto& [x, y] : {std::pair{5.0F, 5.2F},
                             {12.5F, -4.2F},
                             {19.0F, 4.6F},
                             {26.5F, -6.8F},
                             {33.0F, 4.4F},
                             {42.0F, -3.6F},
                             {47.0F, 5.5F}}) {
    stand(x, y);
    plants.Tree(Between(5.0, 7.5), Between(1.7, 2.5), {8.0F, 0.33F});
  }
  for (const auto& [x, y] : {std::pair{3.5F, -3.0F},
                             {8.0F, 4.2F},
                             {15.0F, 3.0F},
                             {16.2F, -3.8F},
                             {22.5F, -4.6F},
                             {24.0F, 2.4F},
                             {30.5F, -5.0F},
                             {36.0F, -3.4F},
                             {37.0F, 4.4F},
                             {44.0F, 1.8F},
                             {-5.0F, 2.0F}}) {
    stand(x, y);
    plants.Bush(Between(0.6, 1.1), Between(0.6, 1.2), {14.0F, 0.25F});
  }
  for (int i = 0; i < 26; ++i) {  // scattered, further off
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    stand(Between(-14.0, 66.0), side * Between(13.0, 27.0));
    if (i % 3 == 0) {
      plants.Conifer(Between(6.0, 10.0), Between(1.8, 2.6), {1.4F, 0.7F});
    } else {
      plants.Tree(Between(6.0, 9.0), Between(2.2, 3.2), {1.1F, 0.85F});
    }
  }
  for (int i = 0; i < 54; ++i) {  // the tree line
    const float angle = 2.0F * kPi * (static_cast<float>(i) + Between(-0.3, 0.3)) / 54.0F;
    stand(25.0F + Between(58.0, 66.0) * std::cos(angle), Between(48.0, 55.0) * std::sin(angle));
    plants.Tree(Between(8.0, 13.0), Between(3.6, 5.0), Vegetation::kFar);
    if (i % 2 == 0) {  // undergrowth, through which no sky shows
      stand(25.0F + 61.0F * std::cos(angle + 0.05F), 50.0F * std::sin(angle + 0.05F));
      plants.Bush(Between(4.5, 5.5), Between(2.6, 3.6), Vegetation::kFar);
    }
  }
}

void RoughGround::PutUpThings() {
  StreetFurniture& street = kit_.street;
  constexpr float kSpan_m = 4.4F;
  for (float x = -6.0F; x < 34.0F; x += kSpan_m) {  // it follows the ground from span to span
    street.Stand(x, 7.2F, 0.0F, Height(x + 0.5F * kSpan_m, 7.2F));
    street.RailFence(kSpan_m);
  }
  for (float y = -18.0F; y < 14.0F; y += kSpan_m) {
    street.Stand(51.0F, y, kPi / 2.0F, Height(51.0F, y + 0.5F * kSpan_m));
    street.RailFence(kSpan_m);
  }
  kit_.buildings.Stand(44.5F, 9.5F, -0.5F, Height(46, 10) - 0.05F);
  kit_.buildings.Shed(4.0F, 3.0F);
  kit_.buildings.Stand(9.0F, -11.0F, kPi - 0.3F, Height(8, -12) - 0.05F);
  kit_.buildings.Shed(3.2F, 2.6F);
  kit_.buildings.Stand(72.0F, 12.0F, -kPi / 2.0F, -0.3F);
  kit_.buildings.PutUp(Buildings::House{.width_m = 10, .wall = Buildings::Wall::kBrick});
}

}  // namespace

Result<Place> MakeRoughWorld() { return RoughGround().Make(); }

}  // namespace trailcast::sim
