#include "services/lab/sim/looks/furniture.h"

#include <algorithm>
#include <cmath>

#include "services/lab/sim/looks/indoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;

template <typename Items>
MaterialId Pick(const Items& items, Random& random) {
  return items[static_cast<std::size_t>(random.Integer(0, static_cast<int>(items.size()) - 1))];
}
float Between(Random& random, double low, double high) {
  return static_cast<float>(random.Uniform(low, high));
}

}  // namespace

Furniture::Furniture(SceneBuilder& builder, std::uint64_t seed)
    : b_(builder), random_(seed, "furniture"), moves_(seed, "moved") {
  const V white(255, 255, 255);
  wood_ = b_.AddMaterial("oak", white, WoodGrain({158, 118, 78}, seed));
  light_wood_ = b_.AddMaterial("birch", white, WoodGrain({206, 182, 146}, seed + 1));
  metal_ = b_.AddMaterial("steel", {150, 152, 156});
  dark_ = b_.AddMaterial("black plastic", {42, 42, 46});
  white_ = b_.AddMaterial("white plastic", {214, 214, 210});
  seat_ = b_.AddMaterial("fabric", white, Fabric({52, 72, 112}, seed));
  paper_ = b_.AddMaterial("paper", {240, 240, 236});
  page_ = b_.AddMaterial("page", white, PrintedPage(seed));
  keyboard_ = b_.AddMaterial("keyboard", white, Keyboard());
  whiteboard_ = b_.AddMaterial("whiteboard", white, Whiteboard(seed));
  cupboard_ = b_.AddMaterial("cupboard doors", white, CupboardDoors("LAB 3"));
  leaf_ = b_.AddMaterial("leaf", {64, 112, 58});
  pot_ = b_.AddMaterial("pot", {150, 86, 60});
  view_ = b_.AddMaterial("window view", white, WindowView(seed), true);
  red_ = b_.AddMaterial("red", {178, 48, 44});
  blue_ = b_.AddMaterial("blue", {48, 84, 150});
  for (std::uint64_t i = 0; i < 8; ++i) {
    posters_.push_back(b_.AddMaterial("poster", white, Poster(seed + i)));
  }
  for (std::uint64_t i = 0; i < 5; ++i) {
    screens_.push_back(b_.AddMaterial("screen", {225, 225, 225}, Screen(seed + i), true));
    spines_.push_back(b_.AddMaterial("books", white, BookSpines(seed + i)));
    cartons_.push_back(b_.AddMaterial("carton", white, Carton(seed + i)));
  }
  for (std::uint64_t i = 0; i < 2; ++i) {
    spines_.push_back(b_.AddMaterial("binders", white, Binders(seed + i)));
    instruments_.push_back(b_.AddMaterial("instrument", white, Instrument(seed + i)));
  }
}

void Furniture::Build(float x, float y, float yaw_rad, float z) { b_.Place({x, y, z}, yaw_rad); }

void Furniture::Stand(float x, float y, float yaw_rad, float z) {
  Build(x, y, yaw_rad, z);
  const bool moved = moves_.Uniform() < moved_share_;
  const float by_m = Between(moves_, 0.3, 0.6);
  const bool right = moves_.Uniform() < 0.5;
  const Eigen::Isometry3f stands = b_.place();
  if (moved) b_.PlaceIn(stands, {right ? by_m : -by_m, 0.0F, 0.0F}, 0.0F);
}

void Furniture::MoveSome(double share, std::uint64_t seed) {
  moved_share_ = share;
  moves_ = Random(seed, "moved");
}

void Furniture::Desk(float width, float depth) {
  b_.Box(light_wood_, {0, 0, 0.71F}, {width, depth, 0.74F});
  b_.Box(metal_, {0.03F, 0.04F, 0}, {0.07F, depth - 0.04F, 0.71F});
  b_.Box(metal_, {width - 0.07F, 0.04F, 0}, {width - 0.03F, depth - 0.04F, 0.71F});
  b_.Box(light_wood_, {0.07F, depth - 0.06F, 0.30F}, {width - 0.07F, depth - 0.04F, 0.70F});
  // These are the drawers.
  b_.Box(white_, {width - 0.52F, 0.06F, 0.05F}, {width - 0.10F, depth - 0.1F, 0.62F});
  for (int i = 0; i < 3; ++i) {
    const float z = 0.12F + 0.18F * static_cast<float>(i);
    b_.Box(dark_, {width - 0.38F, 0.045F, z + 0.08F}, {width - 0.24F, 0.06F, z + 0.10F});
    b_.Box(metal_, {width - 0.52F, 0.054F, z - 0.07F}, {width - 0.10F, 0.06F, z - 0.06F});
  }
}

void Furniture::Monitor(float x, float y) {
  constexpr float kTop = 0.74F;
  b_.Box(dark_, {x - 0.10F, y - 0.08F, kTop}, {x + 0.10F, y + 0.08F, kTop + 0.02F});
  b_.Box(dark_, {x - 0.02F, y + 0.01F, kTop}, {x + 0.02F, y + 0.04F, kTop + 0.30F});
  b_.Box(dark_, {x - 0.27F, y - 0.02F, kTop + 0.12F}, {x + 0.27F, y + 0.02F, kTop + 0.46F});
  b_.Panel(Pick(screens_, random_), {x - 0.255F, y - 0.024F, kTop + 0.445F}, {0.51F, 0, 0},
           {0, 0, -0.30F});
}

void Furniture::DeskThings(float width, float depth) {
  constexpr float kTop = 0.741F;
  const float middle = width * Between(random_, 0.35, 0.55);
  Monitor(middle, depth - 0.22F);
  if (random_.Uniform() < 0.5 && middle + 0.85F < width) Monitor(middle + 0.58F, depth - 0.20F);
  b_.Box(dark_, {middle - 0.22F, 0.10F, kTop}, {middle + 0.22F, 0.25F, kTop + 0.018F});
  b_.Panel(keyboard_, {middle - 0.22F, 0.25F, kTop + 0.019F}, {0.44F, 0, 0}, {0, -0.15F, 0});
  b_.Box(dark_, {middle + 0.28F, 0.14F, kTop}, {middle + 0.34F, 0.24F, kTop + 0.03F});
  const float left = Between(random_, 0.05, 0.12);
  b_.Panel(page_, {left, 0.42F, kTop + 0.004F}, {0.20F, 0.03F, 0}, {0.04F, -0.28F, 0});
  b_.Cylinder(random_.Uniform() < 0.5 ? red_ : blue_, {left + 0.34F, 0.36F, kTop}, 0.042F, 0.1F);
  float z = kTop;
  for (int i = random_.Integer(1, 4); i > 0; --i) {
    const float tall = Between(random_, 0.02, 0.05);
    const float shift = Between(random_, 0.0, 0.04);
    b_.Box(i % 2 == 0 ? blue_ : pot_, {left + shift, depth - 0.30F, z},
           {left + shift + 0.22F, depth - 0.06F - shift, z + tall});
    z += tall;
  }
}

void Furniture::LabBench(float width, float depth) {
  b_.Box(wood_, {0, 0, 0.86F}, {width, depth, 0.90F});
  b_.Box(white_, {0.05F, 0.10F, 0.08F}, {width - 0.05F, depth, 0.86F});
  const int doors = std::max(1, static_cast<int>(width / 0.6F));
  const float door = (width - 0.1F) / static_cast<float>(doors);
  for (int i = 0; i < doors; ++i) {
    const float x = 0.05F + door * static_cast<float>(i);
    b_.Box(dark_, {x - 0.004F, 0.096F, 0.10F}, {x + 0.004F, 0.10F, 0.84F});
    if (random_.Uniform() < 0.4) {
      b_.Panel(page_, {x + 0.3F * door, 0.097F, 0.62F}, {0.21F, 0, 0}, {0, 0, -0.297F});
    }
    b_.Box(metal_, {x + 0.40F * door, 0.07F, 0.74F}, {x + 0.60F * door, 0.10F, 0.76F});
  }
  for (float x = 0.15F; x + 0.45F < width; x += Between(random_, 0.55, 0.85)) {
    const float tall = Between(random_, 0.16, 0.26);
    const float front = Between(random_, 0.16, 0.26);
    b_.Box(white_, {x, front, 0.90F}, {x + 0.42F, depth - 0.08F, 0.90F + tall});
    b_.Panel(Pick(instruments_, random_), {x + 0.01F, front - 0.004F, 0.89F + tall}, {0.40F, 0, 0},
             {0, 0, 0.02F - tall});
  }
}

void Furniture::Chair() {
  for (int i = 0; i < 5; ++i) {
    const float angle = 1.2566F * static_cast<float>(i) + 0.3F;
    const V foot(0.29F * std::cos(angle), 0.29F * std::sin(angle), 0.05F);
    b_.Bar(dark_, {0, 0, 0.10F}, foot, 0.035F);
    b_.Cylinder(dark_, {foot.x(), foot.y(), 0.0F}, 0.025F, 0.05F, 1.0F, 8);
  }
  b_.Cylinder(metal_, {0, 0, 0.08F}, 0.028F, 0.34F, 1.0F, 10);
  b_.Box(seat_, {-0.24F, -0.24F, 0.42F}, {0.24F, 0.24F, 0.50F}, 0.5F);
  b_.Bar(dark_, {0, 0.20F, 0.45F}, {0, 0.27F, 0.72F}, 0.05F);
  b_.Box(seat_, {-0.21F, 0.24F, 0.62F}, {0.21F, 0.29F, 1.02F}, 0.5F);
  b_.Box(dark_, {-0.29F, -0.12F, 0.64F}, {-0.24F, 0.16F, 0.67F});
  b_.Box(dark_, {0.24F, -0.12F, 0.64F}, {0.29F, 0.16F, 0.67F});
}

void Furniture::RowOfSpines(float width, float depth, float z, float room_m) {
  const MaterialId spines = Pick(spines_, random_);
  const float end = width * Between(random_, 0.65, 1.0) - 0.03F;
  int spine = random_.Integer(0, kSpines - 1);
  for (float x = 0.025F; x < end; ++spine) {
    const float thick = Between(random_, 0.022, 0.055);
    const float tall = room_m * Between(random_, 0.66, 0.92);
    const float front = Between(random_, 0.01, 0.045);
    if (x + thick > end) break;
    const float u = static_cast<float>(spine % kSpines) / kSpines;
    b_.Panel(spines, {x, front, z + tall}, {thick, 0, 0}, {0, 0, -tall},
             {{u, 0.0F}, {u + 1.0F / kSpines, 1.0F}});
    b_.Panel(paper_, {x, depth - 0.04F, z + tall}, {thick, 0, 0}, {0, front - depth + 0.04F, 0});
    // Only the sides that stand out beyond a neighbour are visible, but any of them may.
    b_.Panel(dark_, {x, depth - 0.04F, z + tall}, {0, front - depth + 0.04F, 0}, {0, 0, -tall});
    b_.Panel(dark_, {x + thick, front, z + tall}, {0, depth - 0.04F - front, 0}, {0, 0, -tall});
    x += thick;
  }
}

void Furniture::RowOfCartons(float width, float depth, float z, float room_m) {
  float x = 0.05F;
  while (x < width - 0.2F) {
    const float wide = std::min(Between(random_, 0.22, 0.32), width - 0.04F - x);
    const float tall = room_m * Between(random_, 0.5, 0.85);
    b_.Box(pot_, {x, 0.04F, z}, {x + wide, depth - 0.03F, z + tall});
    b_.Panel(Pick(cartons_, random_), {x, 0.036F, z + tall}, {wide, 0, 0}, {0, 0, -tall});
    x += Between(random_, 0.34, 0.5);
  }
}

void Furniture::Shelf(float width, float height, float depth, int boards) {
  const MaterialId body = random_.Uniform() < 0.5 ? wood_ : light_wood_;
  b_.Box(body, {0, 0, 0}, {0.02F, depth, height});
  b_.Box(body, {width - 0.02F, 0, 0}, {width, depth, height});
  b_.Box(body, {0.02F, depth - 0.01F, 0}, {width - 0.02F, depth, height});
  b_.Box(body, {0.02F, 0, height - 0.02F}, {width - 0.02F, depth, height});
  const float room = (height - 0.08F) / static_cast<float>(boards);
  for (int i = 0; i < boards; ++i) {
    const float z = 0.06F + room * static_cast<float>(i);
    b_.Box(body, {0.02F, 0.005F, z - 0.02F}, {width - 0.02F, depth - 0.01F, z});
    const double kind = random_.Uniform();
    if (kind < 0.7) RowOfSpines(width, depth, z, room - 0.03F);
    if (kind > 0.78) RowOfCartons(width, depth, z, room - 0.03F);
  }
}

void Furniture::Cupboard(float width, float height, float depth) {
  b_.Box(metal_, {0, 0, 0}, {width, depth, height});
  b_.Panel(cupboard_, {0.0F, -0.004F, height}, {width, 0, 0}, {0, 0, 0.06F - height});
  for (float x = 0.03F; x + 0.35F < width; x += 0.42F) {
    const float tall = Between(random_, 0.18, 0.34);
    b_.Box(pot_, {x, 0.06F, height}, {x + 0.36F, depth - 0.05F, height + tall});
    b_.Panel(Pick(cartons_, random_), {x, 0.055F, height + tall}, {0.36F, 0, 0}, {0, 0, -tall});
  }
}

void Furniture::RoundTable() {
  b_.Cylinder(metal_, {0, 0, 0}, 0.25F, 0.02F, 1.0F, 20);
  b_.Cylinder(metal_, {0, 0, 0}, 0.035F, 0.72F);
  b_.Cylinder(wood_, {0, 0, 0.71F}, 0.45F, 0.03F, 3.0F, 28);
  b_.Panel(page_, {-0.20F, 0.18F, 0.745F}, {0.20F, 0.04F, 0}, {0.05F, -0.28F, 0});
  b_.Cylinder(white_, {0.18F, 0.1F, 0.74F}, 0.04F, 0.09F);
}

void Furniture::Plant() {
  b_.Cylinder(pot_, {0, 0, 0}, 0.17F, 0.32F, 1.0F, 18);
  for (int i = 0; i < 34; ++i) {
    const float angle = 2.39996F * static_cast<float>(i);
    const float reach = Between(random_, 0.12, 0.38);
    const float z = 0.32F + Between(random_, 0.25, 0.95);
    const V tip(reach * std::cos(angle), reach * std::sin(angle), z);
    const V root(0.03F * std::cos(angle), 0.03F * std::sin(angle), 0.30F);
    b_.Bar(leaf_, root, 0.55F * tip + V(0, 0, 0.14F), 0.008F);
    const V along = tip - (0.55F * tip + V(0, 0, 0.14F));
    const V side = 0.09F * V(-std::sin(angle), std::cos(angle), 0.3F);
    b_.Panel(leaf_, 0.55F * tip + V(0, 0, 0.14F) - 0.5F * side, side, along);
  }
}

void Furniture::Bin() {
  b_.Cylinder(dark_, {0, 0, 0}, 0.14F, 0.32F, 1.0F, 16);
  b_.Cylinder(paper_, {0.01F, 0, 0.30F}, 0.10F, 0.05F, 1.0F, 7);
}

void Furniture::Cartons(int count) {
  float z = 0.0F;
  for (int i = 0; i < count; ++i) {
    const float wide = Between(random_, 0.36, 0.5);
    const float tall = Between(random_, 0.24, 0.36);
    const float shift = Between(random_, -0.04, 0.04);
    b_.Box(pot_, {shift, 0.004F, z}, {shift + wide, 0.4F, z + tall});
    const MaterialId face = Pick(cartons_, random_);
    b_.Panel(face, {shift, 0, z + tall}, {wide, 0, 0}, {0, 0, -tall});
    b_.Panel(face, {shift - 0.004F, 0.4F, z + tall}, {0, -0.4F, 0}, {0, 0, -tall});
    b_.Panel(face, {shift + wide + 0.004F, 0, z + tall}, {0, 0.4F, 0}, {0, 0, -tall});
    z += tall;
  }
}

void Furniture::Hang(MaterialId picture, float width, float height, float thickness) {
  b_.Box(white_, {0, -thickness, 0}, {width, 0, height});
  b_.Panel(picture, {0, -thickness - 0.003F, height}, {width, 0, 0}, {0, 0, -height});
}

void Furniture::Window(float width, float height) {
  b_.Panel(view_, {0, -0.01F, height}, {width, 0, 0}, {0, 0, -height});
  const auto bar = [&](float x0, float z0, float x1, float z1) {
    b_.Box(white_, {x0, -0.06F, z0}, {x1, 0.0F, z1});
  };
  bar(-0.05F, -0.05F, width + 0.05F, 0.0F);
  bar(-0.05F, height, width + 0.05F, height + 0.05F);
  bar(-0.05F, 0, 0, height);
  bar(width, 0, width + 0.05F, height);
  bar(width / 2 - 0.03F, 0, width / 2 + 0.03F, height);
  b_.Box(light_wood_, {-0.10F, -0.18F, -0.09F}, {width + 0.10F, 0, -0.05F});
}

void Furniture::Door(MaterialId leaf) {
  b_.Box(wood_, {-0.08F, -0.05F, 0}, {0, 0, 2.08F});
  b_.Box(wood_, {0.95F, -0.05F, 0}, {1.03F, 0, 2.08F});
  b_.Box(wood_, {-0.08F, -0.05F, 2.05F}, {1.03F, 0, 2.13F});
  b_.Panel(leaf, {0, -0.02F, 2.05F}, {0.95F, 0, 0}, {0, 0, -2.05F});
  b_.Bar(metal_, {0.86F, -0.07F, 1.02F}, {0.74F, -0.07F, 1.02F}, 0.02F);
}

void Furniture::Radiator(float width) {
  b_.Box(white_, {0, -0.06F, 0.12F}, {width, -0.02F, 0.62F});
  for (float x = 0.03F; x + 0.05F < width; x += 0.08F) {
    b_.Box(white_, {x, -0.09F, 0.14F}, {x + 0.045F, -0.06F, 0.60F});
  }
}

}  // namespace trailcast::sim
