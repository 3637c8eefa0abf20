#include "services/lab/sim/looks/pedestrian.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "services/lab/sim/core/angles.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/src/pedestrian_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;
using image::Color;

constexpr float kLegSwing_rad = 0.42F;
constexpr float kArmSwing_rad = 0.36F;
const V kWhite(255.0F, 255.0F, 255.0F);

constexpr std::array<Color, 8> kCloths = {{{38, 44, 62},
                                           {122, 44, 40},
                                           {70, 84, 58},
                                           {176, 168, 150},
                                           {52, 54, 58},
                                           {196, 152, 60},
                                           {72, 104, 142},
                                           {206, 206, 202}}};
constexpr std::array<Color, 4> kTrousers = {
    {{46, 58, 84}, {40, 40, 44}, {120, 108, 88}, {88, 92, 98}}};
constexpr std::array<Color, 4> kSkins = {
    {{226, 186, 160}, {204, 160, 128}, {150, 106, 78}, {104, 72, 54}}};
constexpr std::array<Color, 4> kHairs = {
    {{44, 34, 28}, {92, 62, 38}, {156, 126, 82}, {128, 126, 124}}};

template <std::size_t N>
Color AnyOf(const std::array<Color, N>& colors, Random& random) {
  return colors[static_cast<std::size_t>(random.Integer(0, static_cast<int>(N) - 1))];
}

// A level oval; a body is a row of them with skin stretched over.
struct Oval {
  V middle;
  float half_x, half_y;
};

// Spans skin from the top down. The texture goes round once, with its middle in front, and down
// once.
void Stretch(SceneBuilder& builder, MaterialId material, const std::vector<Oval>& ovals) {
  constexpr std::uint32_t kSides = 14;
  Mesh skin;
  const float top = ovals.front().middle.z();
  const float height = top - ovals.back().middle.z();
  for (const Oval& oval : ovals) {
    for (std::uint32_t i = 0; i <= kSides; ++i) {
      const float share = static_cast<float>(i) / kSides;
      const float angle = kFullTurn * (share - 0.5F);
      skin.positions.emplace_back(
          oval.middle + V(oval.half_x * std::cos(angle), oval.half_y * std::sin(angle), 0.0F));
      skin.uvs.emplace_back(share, (top - oval.middle.z()) / height);
      // More light from above and from one side makes it look round without a sun.
      skin.shade.push_back(0.52F + 0.14F * oval.middle.z() + 0.12F * std::cos(angle - 0.9F));
    }
  }
  constexpr std::uint32_t kRow = kSides + 1;
  for (std::uint32_t row = 0; row + 1 < ovals.size(); ++row) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = row * kRow + i;
      skin.triangles.push_back({a, a + kRow, a + kRow + 1});
      skin.triangles.push_back({a, a + kRow + 1, a + 1});
    }
  }
  builder.Add(material, skin);
}

// One person's colours and size; the pieces are built one after the other.
class Figure {
 public:
  Figure(std::uint64_t seed, const PedestrianOptions& options)
      : random_(seed, "pedestrian"),
        long_coat_(options.long_coat),
        size_(static_cast<float>(random_.Uniform(0.94, 1.05))),
        cloth_(AnyOf(kCloths, random_)),
        jacket_(Jacket(cloth_, seed)),
        trousers_(TrouserLeg(AnyOf(kTrousers, random_), seed)),
        skin_(AnyOf(kSkins, random_)),
        head_(Head(skin_, AnyOf(kHairs, random_), seed)) {}

  Result<std::shared_ptr<const ActorShape>> Build() {
    ActorShape shape;
    shape.stride_m = 1.4 * static_cast<double>(size_);
    if (auto added = AddPart(shape, V::Zero(), 0.0F, [&] { Trunk(); }); !added) {
      return tl::unexpected(added.error());
    }
    for (const float side : {-1.0F, 1.0F}) {
      const auto legs =
          AddPart(shape, {0, side * 0.095F, 0.90F}, side * kLegSwing_rad, [&] { Leg(side); });
      const auto arms =
          AddPart(shape, {0, side * 0.225F, 1.43F}, -side * kArmSwing_rad, [&] { Arm(side); });
      if (!legs) return tl::unexpected(legs.error());
      if (!arms) return tl::unexpected(arms.error());
    }
    return std::make_shared<const ActorShape>(std::move(shape));
  }

 private:
  template <typename Build>
  Result<void> AddPart(ActorShape& shape, const V& pivot, float swing_rad, const Build& build) {
    builder_ = SceneBuilder();
    build();
    Scene scene = builder_.Take("pedestrian");
    for (Mesh& mesh : scene.meshes) {
      for (V& position : mesh.positions) position *= size_;
    }
    auto body = World::Build(std::move(scene));
    if (!body) return tl::unexpected(body.error());
    shape.parts.push_back({std::move(*body), size_ * pivot, swing_rad});
    return {};
  }

  V SkinColor() const { return {float(skin_[0]), float(skin_[1]), float(skin_[2])}; }

  void Trunk() {
    std::vector<Oval> trunk = {
        {{-0.01F, 0, 1.50F}, 0.060F, 0.070F}, {{-0.01F, 0, 1.47F}, 0.085F, 0.140F},
        {{-0.01F, 0, 1.42F}, 0.115F, 0.205F}, {{0, 0, 1.30F}, 0.130F, 0.195F},
        {{0, 0, 1.08F}, 0.115F, 0.165F},      {{0, 0, 0.92F}, 0.130F, 0.185F}};
    if (long_coat_) {
      trunk.push_back({{0, 0, 0.66F}, 0.165F, 0.225F});
      trunk.push_back({{0, 0, 0.40F}, 0.195F, 0.255F});
    } else {
      trunk.push_back({{0, 0, 0.80F}, 0.130F, 0.180F});
    }
    Stretch(builder_, builder_.AddMaterial("jacket", kWhite, jacket_), trunk);
    Stretch(builder_, builder_.AddMaterial("neck", SkinColor()),
            {{{0, 0, 1.58F}, 0.050F, 0.050F}, {{-0.01F, 0, 1.46F}, 0.055F, 0.055F}});
    Stretch(builder_, builder_.AddMaterial("head", kWhite, head_),
            {{{-0.01F, 0, 1.785F}, 0.010F, 0.010F},
             {{-0.01F, 0, 1.77F}, 0.052F, 0.046F},
             {{-0.005F, 0, 1.74F}, 0.086F, 0.070F},
             {{0, 0, 1.69F}, 0.100F, 0.079F},
             {{0.005F, 0, 1.63F}, 0.096F, 0.074F},
             {{0.015F, 0, 1.57F}, 0.076F, 0.060F},
             {{0.03F, 0, 1.535F}, 0.040F, 0.036F}});
  }

  void Leg(float side) {
    const float y = 0.095F * side;
    Stretch(builder_, builder_.AddMaterial("trousers", kWhite, trousers_),
            {{{0, y, 0.92F}, 0.092F, 0.088F},
             {{0, y, 0.70F}, 0.084F, 0.080F},
             {{0.012F, y, 0.50F}, 0.064F, 0.062F},
             {{-0.01F, y, 0.34F}, 0.066F, 0.060F},
             {{-0.01F, y, 0.07F}, 0.060F, 0.056F}});
    const auto leather = builder_.AddMaterial("shoe", {40, 36, 34});
    Stretch(builder_, leather,
            {{{0.0F, y, 0.12F}, 0.055F, 0.045F},
             {{0.035F, y, 0.075F}, 0.110F, 0.050F},
             {{0.045F, y, 0.03F}, 0.135F, 0.052F}});
    Stretch(builder_, builder_.AddMaterial("sole", {150, 148, 142}),
            {{{0.045F, y, 0.03F}, 0.140F, 0.055F}, {{0.045F, y, 0.0F}, 0.140F, 0.055F}});
  }

  void Arm(float side) {
    const float y = 0.235F * side;
    Stretch(builder_, builder_.AddMaterial("sleeve", kWhite, jacket_),
            {{{0, 0.87F * y, 1.465F}, 0.020F, 0.015F},
             {{0, 0.95F * y, 1.44F}, 0.058F, 0.050F},
             {{0, y, 1.28F}, 0.056F, 0.050F},
             {{-0.01F, 1.06F * y, 1.12F}, 0.050F, 0.046F},
             {{0.03F, 1.04F * y, 0.88F}, 0.040F, 0.038F}});
    Stretch(builder_, builder_.AddMaterial("hand", SkinColor()),
            {{{0.035F, 1.04F * y, 0.89F}, 0.030F, 0.022F},
             {{0.05F, 1.03F * y, 0.82F}, 0.042F, 0.022F},
             {{0.06F, 1.0F * y, 0.75F}, 0.018F, 0.015F}});
  }

  Random random_;
  bool long_coat_;
  float size_;
  Color cloth_;
  TexturePtr jacket_, trousers_;
  Color skin_;
  TexturePtr head_;
  SceneBuilder builder_;
};

}  // namespace

Result<std::shared_ptr<const ActorShape>> MakePedestrian(std::uint64_t seed,
                                                         const PedestrianOptions& options) {
  return Figure(seed, options).Build();
}

}  // namespace trailcast::sim
