#include "services/lab/sim/looks/street_furniture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/lab/sim/looks/indoor_textures.h"
#include "services/lab/sim/looks/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;

}  // namespace

StreetFurniture::StreetFurniture(SceneBuilder& builder, std::uint64_t seed)
    : b_(builder), random_(seed, "street furniture") {
  const V white(255, 255, 255);
  steel_ = b_.AddMaterial("galvanised steel", {142, 146, 148});
  lamp_ = b_.AddMaterial("lamp glass", {222, 220, 206});
  black_ = b_.AddMaterial("black iron", {48, 50, 52});
  green_ = b_.AddMaterial("green paint", {52, 82, 60});
  white_wood_ = b_.AddMaterial("painted wood", {214, 212, 204});
  weathered_ = b_.AddMaterial("weathered wood", white, Planks({138, 124, 106}, seed));
  boards_ = b_.AddMaterial("fence boards", white, Planks({126, 98, 72}, seed + 1));
  timber_ = b_.AddMaterial("timber", white, WoodGrain({146, 116, 82}, seed));
  brick_ = b_.AddMaterial("garden wall", {228, 214, 206}, Brickwork(seed + 1));
  coping_ = b_.AddMaterial("coping", {168, 164, 156});
  parking_sign_ = b_.AddMaterial("parking sign", white, sim::ParkingSign("8-18 h"));
  round_sign_ = b_.AddMaterial("speed sign", white, RoundSign("30"));
  poster_ = b_.AddMaterial("notice", white, Poster(seed));
}

void StreetFurniture::Stand(float x, float y, float yaw_rad, float z) {
  b_.Place({x, y, z}, yaw_rad);
}

float StreetFurniture::StandAlong(const Eigen::Vector2f& from, const Eigen::Vector2f& to) {
  const Eigen::Vector2f along = to - from;
  Stand(from.x(), from.y(), std::atan2(along.y(), along.x()));
  return along.norm();
}

void StreetFurniture::LampPost(float height_m) {
  b_.Tube(steel_, {0, 0, 0}, {0, 0, 0.9F}, 0.10F, 0.10F, 10);
  b_.Tube(steel_, {0, 0, 0.9F}, {0, 0, height_m}, 0.065F, 0.04F, 8);
  b_.Bar(steel_, {0, 0, height_m - 0.02F}, {0, -1.0F, height_m + 0.18F}, 0.05F);
  b_.Box(steel_, {-0.12F, -1.55F, height_m + 0.14F}, {0.12F, -0.9F, height_m + 0.25F});
  b_.Box(lamp_, {-0.10F, -1.50F, height_m + 0.08F}, {0.10F, -1.0F, height_m + 0.14F});
  b_.Panel(poster_, {-0.06F, -0.106F, 0.82F}, {0.12F, 0, 0}, {0, 0, -0.17F});
}

void StreetFurniture::Sign(MaterialId face, float width_m, float height_m) {
  constexpr float kTop_m = 2.5F;
  b_.Tube(steel_, {0, 0, 0}, {0, 0, kTop_m}, 0.03F, 0.03F, 7);
  const float half = 0.5F * width_m;
  b_.Box(steel_, {-half, -0.05F, kTop_m - height_m}, {half, -0.035F, kTop_m});
  b_.Panel(face, {-half, -0.054F, kTop_m}, {width_m, 0, 0}, {0, 0, -height_m});
}

void StreetFurniture::ParkingSign() { Sign(parking_sign_, 0.5F, 0.75F); }

void StreetFurniture::SpeedSign() {
  b_.Tube(steel_, {0, 0, 0}, {0, 0, 2.5F}, 0.03F, 0.03F, 7);
  b_.Disc(round_sign_, {0, -0.05F, 2.3F}, -V::UnitY(), 0.3F, 20);
  b_.Disc(steel_, {0, -0.045F, 2.3F}, V::UnitY(), 0.3F, 20);
}

void StreetFurniture::Bollard() {
  b_.Tube(black_, {0, 0, 0}, {0, 0, 0.85F}, 0.07F, 0.06F, 9);
  b_.Tube(lamp_, {0, 0, 0.68F}, {0, 0, 0.78F}, 0.068F, 0.066F, 9);
  b_.Disc(black_, {0, 0, 0.85F}, V::UnitZ(), 0.06F, 9);
}

void StreetFurniture::Bench() {
  for (const float x : {-0.65F, 0.65F}) {
    b_.Box(black_, {x - 0.03F, -0.25F, 0}, {x + 0.03F, 0.25F, 0.42F});
    b_.Bar(black_, {x, 0.22F, 0.4F}, {x, 0.36F, 0.88F}, 0.05F);
  }
  for (int i = 0; i < 4; ++i) {
    const float y = -0.24F + 0.13F * static_cast<float>(i);
    b_.Box(timber_, {-0.85F, y, 0.42F}, {0.85F, y + 0.10F, 0.46F});
  }
  for (const float z : {0.56F, 0.72F}) {
    b_.Box(timber_, {-0.85F, 0.26F + 0.3F * (z - 0.5F), z},
           {0.85F, 0.29F + 0.3F * (z - 0.5F), z + 0.11F});
  }
}

void StreetFurniture::LitterBin() {
  b_.Tube(green_, {0, 0, 0.06F}, {0, 0, 0.85F}, 0.20F, 0.23F, 12);
  b_.Tube(steel_, {0, 0, 0.80F}, {0, 0, 0.86F}, 0.235F, 0.235F, 12);
  b_.Disc(black_, {0, 0, 0.84F}, V::UnitZ(), 0.22F, 12);
  b_.Panel(poster_, {-0.09F, -0.225F, 0.66F}, {0.18F, 0, 0}, {0, 0, -0.25F});
}

void StreetFurniture::Bicycle() {
  constexpr float kWheel_m = 0.34F;
  for (const float x : {-0.52F, 0.52F}) {
    for (int i = 0; i < 14; ++i) {
      const auto rim = [x](int step) -> V {
        const float angle = 6.2832F * static_cast<float>(step) / 14.0F;
        return {x + kWheel_m * std::cos(angle), 0.0F, kWheel_m + kWheel_m * std::sin(angle)};
      };
      b_.Bar(black_, rim(i), rim(i + 1), 0.035F);
    }
  }
  const V crank(-0.05F, 0, 0.30F);
  const V seat(-0.18F, 0, 0.82F);
  const V head(0.36F, 0, 0.80F);
  const V handle(0.32F, 0, 1.0F);
  for (const auto& [from, to] :
       {std::pair{crank, seat}, std::pair{seat, head}, std::pair{crank, head},
        std::pair{head, handle}, std::pair{V(-0.52F, 0, kWheel_m), crank},
        std::pair{V(-0.52F, 0, kWheel_m), seat}, std::pair{V(0.52F, 0, kWheel_m), head}}) {
    b_.Bar(green_, from, to, 0.035F);
  }
  b_.Bar(black_, {0.32F, -0.26F, 1.0F}, {0.32F, 0.26F, 1.0F}, 0.03F);
  b_.Box(black_, {-0.30F, -0.07F, 0.82F}, {-0.06F, 0.07F, 0.88F});
}

void StreetFurniture::PicketFence(float length_m, float height_m) {
  constexpr float kPitch_m = 0.14F;
  for (float x = 0.0F; x <= length_m; x += 2.1F) {
    b_.Box(white_wood_, {x - 0.05F, 0.02F, -0.1F}, {x + 0.05F, 0.12F, height_m + 0.06F});
  }
  for (const float z : {0.28F, height_m - 0.24F}) {
    b_.Box(white_wood_, {0, 0, z}, {length_m, 0.035F, z + 0.08F});
  }
  for (float x = 0.05F; x + 0.08F < length_m; x += kPitch_m) {
    const float top = height_m + static_cast<float>(random_.Uniform(-0.015, 0.015));
    b_.Quad(white_wood_, {V(x, -0.01F, top), V(x, -0.01F, 0.08F), V(x + 0.085F, -0.01F, 0.08F),
                          V(x + 0.085F, -0.01F, top)});
  }
}

void StreetFurniture::BoardFence(float length_m, float height_m) {
  for (float x = 0.0F; x < length_m; x += 2.0F) {
    const float end = std::min(x + 1.96F, length_m);
    const float top = height_m + static_cast<float>(random_.Uniform(-0.03, 0.03));
    b_.Box(boards_, {x + 0.08F, 0, -0.05F}, {end, 0.03F, top}, 1.2F);
    b_.Box(timber_, {x - 0.02F, -0.03F, -0.1F}, {x + 0.08F, 0.08F, height_m + 0.10F});
  }
}

void StreetFurniture::RailFence(float length_m, float height_m) {
  for (float x = 0.0F; x < length_m + 0.1F; x += 2.2F) {
    const auto lean = static_cast<float>(random_.Uniform(-0.04, 0.04));
    b_.Tube(weathered_, {x, 0, -0.4F}, {x + lean, lean, height_m + 0.1F}, 0.065F, 0.055F, 7);
  }
  for (int rail = 1; rail <= 3; ++rail) {
    const float z = height_m * static_cast<float>(rail) / 3.0F - 0.08F;
    b_.Box(weathered_, {-0.1F, -0.09F, z - 0.05F}, {length_m + 0.1F, -0.05F, z + 0.05F}, 1.3F);
  }
}

void StreetFurniture::Railing(float length_m, float height_m) {
  b_.Bar(black_, {0, 0, height_m}, {length_m, 0, height_m}, 0.05F);
  b_.Bar(black_, {0, 0, 0.12F}, {length_m, 0, 0.12F}, 0.03F);
  for (float x = 0.0F; x <= length_m; x += 1.8F) {
    b_.Bar(black_, {x, 0, -0.05F}, {x, 0, height_m}, 0.05F);
  }
  for (float x = 0.12F; x < length_m; x += 0.12F) {
    b_.Bar(black_, {x, 0, 0.12F}, {x, 0, height_m}, 0.016F);
  }
}

void StreetFurniture::GardenWall(float length_m, float height_m) {
  b_.Box(brick_, {0, 0, -0.1F}, {length_m, 0.24F, height_m}, 1.5F);
  b_.Box(coping_, {-0.03F, -0.03F, height_m}, {length_m + 0.03F, 0.27F, height_m + 0.06F});
  for (float x = 0.0F; x <= length_m; x += 3.0F) {
    b_.Box(brick_, {x - 0.18F, -0.06F, -0.1F}, {x + 0.18F, 0.30F, height_m + 0.10F}, 1.5F);
    b_.Box(coping_, {x - 0.21F, -0.09F, height_m + 0.10F}, {x + 0.21F, 0.33F, height_m + 0.16F});
  }
}

}  // namespace trailcast::sim
