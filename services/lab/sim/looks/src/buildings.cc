#include "services/lab/sim/looks/buildings.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/looks/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;

constexpr float kQuarter = std::numbers::pi_v<float> / 2.0F;
constexpr float kStorey_m = 3.0F;
constexpr float kWallTile_m = 1.5F;

}  // namespace

Buildings::Buildings(SceneBuilder& builder, std::uint64_t seed)
    : b_(builder), random_(seed, "buildings") {
  const V white(255, 255, 255);
  const auto brick = Brickwork(seed);
  walls_ = {b_.AddMaterial("brick wall", white, brick),
            b_.AddMaterial("dark brick wall", {196, 190, 196}, brick),
            b_.AddMaterial("white plaster", white, Concrete({206, 204, 196}, seed + 1)),
            b_.AddMaterial("yellow plaster", white, Concrete({198, 176, 132}, seed + 2)),
            b_.AddMaterial("concrete wall", white, Concrete({150, 148, 144}, seed + 3))};
  for (std::uint64_t i = 0; i < 6; ++i) {
    windows_.push_back(b_.AddMaterial("house window", white, HouseWindow(seed + i)));
  }
  for (std::uint64_t i = 0; i < 3; ++i) {
    shops_.push_back(b_.AddMaterial("shop window", white, ShopWindow(seed + i)));
    signs_.push_back(b_.AddMaterial("shop sign", white, ShopSign(seed + i)));
  }
  doors_ = {b_.AddMaterial("green door", white, HouseDoor({52, 84, 62}, "12")),
            b_.AddMaterial("red door", white, HouseDoor({132, 46, 40}, "7A")),
            b_.AddMaterial("blue door", white, HouseDoor({48, 66, 104}, "31"))};
  sill_ = b_.AddMaterial("window sill", {178, 174, 166});
  frame_ = b_.AddMaterial("door frame", {208, 206, 198});
  roof_ = b_.AddMaterial("roof tiles", white, RoofTiles({146, 88, 68}, seed));
  flat_roof_ = b_.AddMaterial("roofing felt", {92, 92, 94});
  planks_ = b_.AddMaterial("shed planks", white, Planks({122, 96, 70}, seed));
  garage_ = b_.AddMaterial("garage door", white, GarageDoor({150, 156, 158}));
  pipe_ = b_.AddMaterial("rain pipe", {112, 114, 114});
}

void Buildings::Stand(float x, float y, float yaw_rad, float z) { b_.Place({x, y, z}, yaw_rad); }

MaterialId Buildings::Any(const std::vector<MaterialId>& choice) {
  return choice[static_cast<std::size_t>(random_.Integer(0, static_cast<int>(choice.size()) - 1))];
}

void Buildings::Window(const Opening& at, MaterialId picture) {
  b_.Panel(picture, {at.x, -0.02F, at.z + at.height}, {at.width, 0, 0}, {0, 0, -at.height});
  b_.Box(sill_, {at.x - 0.06F, -0.14F, at.z - 0.08F}, {at.x + at.width + 0.06F, 0.0F, at.z});
  b_.Box(sill_, {at.x - 0.08F, -0.05F, at.z + at.height},
         {at.x + at.width + 0.08F, 0.0F, at.z + at.height + 0.14F});
}

void Buildings::WindowRow(float width_m, float z, float pitch_m, bool alike) {
  constexpr float kWide_m = 1.05F;
  const int count = std::max(1, static_cast<int>((width_m - 0.8F) / pitch_m));
  const float step = width_m / static_cast<float>(count);
  for (int i = 0; i < count; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * step - 0.5F * kWide_m;
    Window({x, z, kWide_m, 1.5F}, alike ? windows_.front() : Any(windows_));
  }
}

void Buildings::Entrance(float x) {
  b_.Panel(Any(doors_), {x, -0.045F, 2.15F}, {1.05F, 0, 0}, {0, 0, -2.15F});
  b_.Box(frame_, {x - 0.12F, -0.06F, 0}, {x, 0, 2.27F});
  b_.Box(frame_, {x + 1.05F, -0.06F, 0}, {x + 1.17F, 0, 2.27F});
  b_.Box(frame_, {x - 0.12F, -0.06F, 2.15F}, {x + 1.17F, 0, 2.27F});
  b_.Box(sill_, {x - 0.2F, -0.5F, 0}, {x + 1.25F, 0, 0.14F});
  b_.Box(flat_roof_, {x - 0.3F, -0.7F, 2.45F}, {x + 1.35F, 0, 2.52F});
}

void Buildings::Shops(float width_m) {
  constexpr float kShop_m = 6.0F;
  for (float x = 0.6F; x + kShop_m < width_m; x += kShop_m + 0.5F) {
    b_.Panel(Any(shops_), {x + 0.1F, -0.045F, 2.35F}, {4.2F, 0, 0}, {0, 0, -1.9F});
    b_.Panel(Any(doors_), {x + 4.6F, -0.045F, 2.35F}, {1.05F, 0, 0}, {0, 0, -2.35F});
    b_.Box(frame_, {x, -0.12F, 2.5F}, {x + kShop_m - 0.2F, 0, 3.05F});
    b_.Panel(Any(signs_), {x + 0.9F, -0.125F, 3.02F}, {3.0F, 0, 0}, {0, 0, -0.5F});
  }
}

void Buildings::PutUp(const Block& block) {
  const float height = kStorey_m * static_cast<float>(block.storeys) + 0.5F;
  const V size(block.width_m, block.depth_m, height);
  const Eigen::Isometry3f place = b_.place();
  b_.Box(wall(block.wall), {0, 0, -0.05F}, size, kWallTile_m);
  b_.Box(walls_.back(), {-0.04F, -0.04F, 0.0F}, {size.x() + 0.04F, size.y() + 0.04F, 0.45F}, 3.0F);
  b_.Box(flat_roof_, {-0.15F, -0.15F, height}, {size.x() + 0.15F, size.y() + 0.15F, height + 0.2F});
  const std::array<V, 4> corners = {V(0, 0, 0), V(size.x(), 0, 0), V(size.x(), size.y(), 0),
                                    V(0, size.y(), 0)};
  for (int side = 0; side < 4; ++side) {
    const float wide = side % 2 == 0 ? size.x() : size.y();
    b_.PlaceIn(place, corners[static_cast<std::size_t>(side)], kQuarter * static_cast<float>(side));
    for (int storey = 0; storey < block.storeys; ++storey) {
      if (side == 0 && storey == 0 && block.shops) {
        Shops(wide);
        continue;
      }
      WindowRow(wide, kStorey_m * static_cast<float>(storey) + 1.1F, block.window_pitch_m, false);
    }
    b_.Tube(pipe_, {0.25F, -0.07F, 0.1F}, {0.25F, -0.07F, height}, 0.05F, 0.05F, 6);
    if (side == 0 && !block.shops) Entrance(0.5F * wide - 1.9F);
  }
}

void Buildings::Roof(float width_m, float depth_m, float eaves_m) {
  constexpr float kOver_m = 0.4F;
  const float ridge = eaves_m + 0.36F * depth_m;
  const float low = eaves_m - 0.36F * 2.0F * kOver_m;
  const float middle = 0.5F * depth_m;
  const float left = -kOver_m;
  const float right = width_m + kOver_m;
  const TexturePart tiled = {{0, 0}, {(right - left) / 2.0F, depth_m / 3.2F}};
  b_.Quad(roof_,
          {V(left, middle, ridge), V(left, -kOver_m, low), V(right, -kOver_m, low),
           V(right, middle, ridge)},
          tiled);
  b_.Quad(roof_,
          {V(right, middle, ridge), V(right, depth_m + kOver_m, low),
           V(left, depth_m + kOver_m, low), V(left, middle, ridge)},
          tiled);
  b_.Tube(pipe_, {left, -kOver_m, low}, {right, -kOver_m, low}, 0.07F, 0.07F, 6);
}

void Buildings::PutUp(const House& house) {
  const float eaves = 2.8F * static_cast<float>(house.storeys);
  const float wide = house.width_m;
  const float deep = house.depth_m;
  const Eigen::Isometry3f place = b_.place();
  const MaterialId walls = wall(house.wall);
  b_.Box(walls, {0, 0, -0.05F}, {wide, deep, eaves}, kWallTile_m);
  b_.Box(walls_.back(), {-0.03F, -0.03F, 0.0F}, {wide + 0.03F, deep + 0.03F, 0.35F}, 3.0F);
  const V top(0, 0.5F * deep, eaves + 0.36F * deep);
  for (const float x : {0.0F, wide}) {  // gables
    b_.Quad(walls, {top + V(x, 0, 0), V(x, 0, eaves), V(x, deep, eaves), top + V(x, 0, 0)},
            {{0, 0}, {deep / kWallTile_m, 2.0F}});
  }
  Roof(wide, deep, eaves);
  b_.Box(walls_.front(), {0.7F * wide, 0.55F * deep, eaves},
         {0.7F * wide + 0.6F, 0.55F * deep + 0.6F, eaves + 0.36F * deep + 0.5F}, kWallTile_m);
  Entrance(0.45F * wide);
  const MaterialId picture = house.alike ? windows_.front() : Any(windows_);
  Window({0.1F * wide, 1.0F, 1.2F, 1.35F}, picture);
  if (house.garage) {
    b_.Panel(garage_, {0.66F * wide, -0.045F, 2.2F}, {2.5F, 0, 0}, {0, 0, -2.2F});
  } else {
    Window({0.75F * wide, 1.0F, 1.2F, 1.35F}, house.alike ? windows_.front() : Any(windows_));
  }
  for (int storey = 1; storey < house.storeys; ++storey) {
    WindowRow(wide, 2.8F * static_cast<float>(storey) + 0.9F, 2.3F, house.alike);
  }
  b_.PlaceIn(place, {wide, 0, 0}, kQuarter);
  WindowRow(deep, 1.1F, 3.4F, house.alike);
  b_.PlaceIn(place, {0, deep, 0}, -kQuarter);
  WindowRow(deep, 1.1F, 3.4F, house.alike);
}

void Buildings::Shed(float width, float depth) {
  constexpr float kHigh_m = 2.2F;
  b_.Box(planks_, {0, 0, -0.2F}, {width, depth, kHigh_m}, 1.2F);
  b_.Panel(Any(doors_), {0.2F * width, -0.03F, 1.95F}, {0.9F, 0, 0}, {0, 0, -1.95F});
  Window({0.68F * width, 1.1F, 0.6F, 0.7F}, windows_.front());
  b_.Quad(flat_roof_, {V(-0.2F, depth + 0.2F, kHigh_m + 0.05F), V(-0.2F, -0.3F, kHigh_m + 0.35F),
                       V(width + 0.2F, -0.3F, kHigh_m + 0.35F),
                       V(width + 0.2F, depth + 0.2F, kHigh_m + 0.05F)});
  b_.Quad(planks_, {V(0, 0, kHigh_m + 0.33F), V(0, 0, kHigh_m), V(width, 0, kHigh_m),
                    V(width, 0, kHigh_m + 0.33F)});
}

}  // namespace trailcast::sim
