#include "services/sim/vehicles.h"

#include <numbers>

#include "services/sim/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;
using Corners = std::array<V, 4>;

constexpr float kQuarter = std::numbers::pi_v<float> / 2.0F;

// The part of a quadrilateral between shares of its width and height, lifted off it a little.
Corners PartOf(const Corners& quad, float left, float top, float right, float bottom,
               float lift_m = 0.006F) {
  const V normal = (quad[1] - quad[0]).cross(quad[3] - quad[0]).normalized();
  const auto at = [&](float u, float v) -> V {
    const V upper = quad[0] + u * (quad[3] - quad[0]);
    const V lower = quad[1] + u * (quad[2] - quad[1]);
    return upper + v * (lower - upper) + lift_m * normal;
  };
  return {at(left, top), at(left, bottom), at(right, bottom), at(right, top)};
}

}  // namespace

// Sizes in metres; y runs from the nose (low) to the tail.
struct Vehicles::Shape {
  std::vector<Section> sections;
  // The cabin's foot and roof: from, to, height, half width.
  float foot_from, foot_to, foot_z, foot_half;
  float roof_from, roof_to, roof_z, roof_half;
  float pillar;  // share of the side's length at which the front doors end
  float front_axle, rear_axle, wheel_radius;
  bool side_glass_behind;  // windows behind the front doors
};

const Vehicles::Shape& Vehicles::ShapeOf(VehicleShape shape) {
  static const std::array<Shape, 4> shapes = {Shape{{{-2.22F, 0.34F, 0.60F, 0.76F},
                                                     {-2.14F, 0.22F, 0.72F, 0.84F},
                                                     {-1.15F, 0.20F, 0.92F, 0.88F},
                                                     {0.20F, 0.19F, 0.95F, 0.89F},
                                                     {1.45F, 0.20F, 0.98F, 0.88F},
                                                     {2.14F, 0.24F, 0.95F, 0.83F},
                                                     {2.22F, 0.36F, 0.80F, 0.78F}},
                                                    -1.18F,
                                                    1.62F,
                                                    0.92F,
                                                    0.80F,
                                                    -0.36F,
                                                    0.98F,
                                                    1.43F,
                                                    0.58F,
                                                    0.50F,
                                                    -1.36F,
                                                    1.34F,
                                                    0.32F,
                                                    true},
                                              Shape{{{-1.92F, 0.34F, 0.62F, 0.74F},
                                                     {-1.84F, 0.21F, 0.76F, 0.81F},
                                                     {-0.98F, 0.19F, 0.96F, 0.85F},
                                                     {0.30F, 0.18F, 1.00F, 0.86F},
                                                     {1.50F, 0.20F, 1.02F, 0.84F},
                                                     {1.90F, 0.26F, 0.98F, 0.80F},
                                                     {1.96F, 0.36F, 0.80F, 0.76F}},
                                                    -1.04F,
                                                    1.88F,
                                                    0.96F,
                                                    0.78F,
                                                    -0.26F,
                                                    1.50F,
                                                    1.50F,
                                                    0.58F,
                                                    0.55F,
                                                    -1.20F,
                                                    1.24F,
                                                    0.30F,
                                                    true},
                                              Shape{{{-2.24F, 0.34F, 0.62F, 0.77F},
                                                     {-2.16F, 0.22F, 0.74F, 0.85F},
                                                     {-1.20F, 0.20F, 0.94F, 0.89F},
                                                     {0.20F, 0.19F, 0.97F, 0.90F},
                                                     {1.70F, 0.20F, 1.00F, 0.89F},
                                                     {2.22F, 0.24F, 0.97F, 0.85F},
                                                     {2.28F, 0.36F, 0.80F, 0.80F}},
                                                    -1.22F,
                                                    2.18F,
                                                    0.94F,
                                                    0.81F,
                                                    -0.40F,
                                                    1.86F,
                                                    1.48F,
                                                    0.61F,
                                                    0.46F,
                                                    -1.38F,
                                                    1.36F,
                                                    0.32F,
                                                    true},
                                              Shape{{{-2.52F, 0.38F, 0.66F, 0.84F},
                                                     {-2.42F, 0.26F, 0.98F, 0.94F},
                                                     {-1.78F, 0.24F, 1.16F, 0.97F},
                                                     {0.00F, 0.24F, 1.22F, 0.98F},
                                                     {2.30F, 0.24F, 1.22F, 0.98F},
                                                     {2.50F, 0.30F, 1.20F, 0.96F},
                                                     {2.54F, 0.44F, 1.00F, 0.94F}},
                                                    -1.98F,
                                                    2.50F,
                                                    1.14F,
                                                    0.95F,
                                                    -1.30F,
                                                    2.42F,
                                                    2.22F,
                                                    0.86F,
                                                    0.30F,
                                                    -1.68F,
                                                    1.60F,
                                                    0.35F,
                                                    false}};
  return shapes[static_cast<std::size_t>(shape)];
}

Vehicles::Vehicles(SceneBuilder& builder, std::uint64_t seed)
    : b_(builder), random_(seed, "vehicles") {
  const V white(255, 255, 255);
  const std::array<image::Color, 7> colors = {{{196, 198, 200},
                                               {44, 46, 52},
                                               {146, 40, 38},
                                               {52, 78, 128},
                                               {212, 210, 202},
                                               {110, 116, 120},
                                               {64, 92, 74}}};
  for (const image::Color& color : colors) {
    const auto i = seed + paints_.size();
    paints_.push_back({b_.AddMaterial("car paint", white, CarPaint(color, i)),
                       b_.AddMaterial("car front", white, CarFront(color, i)),
                       b_.AddMaterial("car rear", white, CarRear(color, i))});
  }
  for (std::uint64_t i = 0; i < 6; ++i) {
    plates_.push_back(b_.AddMaterial("plate", white, NumberPlate(seed + i)));
  }
  glass_ = b_.AddMaterial("car glass", white, CarGlass(seed));
  black_ = b_.AddMaterial("underbody", {26, 26, 28});
  tyre_ = b_.AddMaterial("tyre", {44, 44, 46});
  wheel_ = b_.AddMaterial("wheel", white, Wheel());
  chrome_ = b_.AddMaterial("chrome", {176, 178, 182});
}

void Vehicles::ParkAny(float x, float y, float heading_rad) {
  Park(x, y, heading_rad, static_cast<VehicleShape>(random_.Integer(0, 2)));
}

void Vehicles::Park(float x, float y, float heading_rad, VehicleShape shape) {
  const Shape& s = ShapeOf(shape);
  const auto last = static_cast<int>(paints_.size()) - 1;
  const Paint& paint = paints_[static_cast<std::size_t>(random_.Integer(0, last))];
  b_.Place({x, y, 0.0F}, heading_rad + kQuarter);
  Body(s, paint);
  Cabin(s, paint);
  Wheels(s);
  Fittings(s, paint);
}

void Vehicles::Body(const Shape& shape, const Paint& paint) {
  const auto corner = [](const Section& s, float side, float z) -> V {
    return {side * s.half_width, s.y, z};
  };
  for (std::size_t i = 0; i + 1 < shape.sections.size(); ++i) {
    const Section& a = shape.sections[i];
    const Section& c = shape.sections[i + 1];
    const TexturePart flank = {{a.y / 4.0F, 0.36F}, {c.y / 4.0F, 1.0F}};
    b_.Quad(
        paint.flank,
        {corner(c, -1, c.high), corner(c, -1, c.low), corner(a, -1, a.low), corner(a, -1, a.high)},
        flank);
    b_.Quad(paint.flank,
            {corner(a, 1, a.high), corner(a, 1, a.low), corner(c, 1, c.low), corner(c, 1, c.high)},
            flank);
    b_.Quad(
        paint.flank,
        {corner(c, -1, c.high), corner(a, -1, a.high), corner(a, 1, a.high), corner(c, 1, c.high)},
        {{0.0F, 0.05F}, {0.6F, 0.30F}});
    b_.Quad(black_,
            {corner(a, -1, a.low), corner(c, -1, c.low), corner(c, 1, c.low), corner(a, 1, a.low)});
  }
  const Section& nose = shape.sections.front();
  const Section& tail = shape.sections.back();
  b_.Quad(black_, {corner(nose, -1, nose.high), corner(nose, -1, nose.low),
                   corner(nose, 1, nose.low), corner(nose, 1, nose.high)});
  b_.Quad(black_, {corner(tail, 1, tail.high), corner(tail, 1, tail.low),
                   corner(tail, -1, tail.low), corner(tail, -1, tail.high)});
}

void Vehicles::Cabin(const Shape& shape, const Paint& paint) {
  const auto foot = [&](float side, float y) -> V {
    return {side * shape.foot_half, y, shape.foot_z};
  };
  const auto roof = [&](float side, float y) -> V {
    return {side * shape.roof_half, y, shape.roof_z};
  };
  const Corners windscreen = {roof(-1, shape.roof_from), foot(-1, shape.foot_from),
                              foot(1, shape.foot_from), roof(1, shape.roof_from)};
  const Corners rear = {roof(1, shape.roof_to), foot(1, shape.foot_to), foot(-1, shape.foot_to),
                        roof(-1, shape.roof_to)};
  const Corners right = {roof(1, shape.roof_from), foot(1, shape.foot_from), foot(1, shape.foot_to),
                         roof(1, shape.roof_to)};
  const Corners left = {roof(-1, shape.roof_to), foot(-1, shape.foot_to), foot(-1, shape.foot_from),
                        roof(-1, shape.roof_from)};
  for (const Corners& side : {windscreen, rear, right, left}) {
    b_.Quad(paint.flank, side, {{0.0F, 0.10F}, {0.7F, 0.40F}});
  }
  b_.Quad(paint.flank,
          {roof(-1, shape.roof_to), roof(-1, shape.roof_from), roof(1, shape.roof_from),
           roof(1, shape.roof_to)},
          {{0.0F, 0.0F}, {0.7F, 0.2F}});
  b_.Quad(glass_, PartOf(windscreen, 0.05F, 0.06F, 0.95F, 0.92F));
  b_.Quad(glass_, PartOf(rear, 0.08F, 0.08F, 0.92F, shape.side_glass_behind ? 0.9F : 0.5F));
  // On the right the nose is at the left end of the picture, on the left side at its right end.
  const float pillar = shape.pillar;
  b_.Quad(glass_, PartOf(right, 0.06F, 0.1F, pillar - 0.02F, 0.94F));
  b_.Quad(glass_, PartOf(left, 1.02F - pillar, 0.1F, 0.94F, 0.94F));
  if (!shape.side_glass_behind) return;
  b_.Quad(glass_, PartOf(right, pillar + 0.02F, 0.1F, 0.92F, 0.94F));
  b_.Quad(glass_, PartOf(left, 0.08F, 0.1F, 0.98F - pillar, 0.94F));
}

void Vehicles::Wheels(const Shape& shape) {
  constexpr int kSides = 14;
  const float radius = shape.wheel_radius;
  const float flank = shape.sections[3].half_width;
  for (const float y : {shape.front_axle, shape.rear_axle}) {
    for (const float side : {-1.0F, 1.0F}) {
      const V out(side, 0.0F, 0.0F);
      const V hub(side * (flank + 0.012F), y, radius);
      b_.Disc(black_, hub - 0.006F * out + V(0, 0, 0.03F), out, radius + 0.05F, kSides);
      b_.Disc(wheel_, hub, out, radius, kSides);
      b_.Tube(tyre_, hub, hub - 0.22F * out, radius, radius, kSides);
    }
  }
}

void Vehicles::Fittings(const Shape& shape, const Paint& paint) {
  const Section& nose = shape.sections[1];
  const Section& tail = shape.sections[shape.sections.size() - 2];
  const auto upright = [&](MaterialId material, float y, float facing, float half, float low,
                           float high) {
    const float x = facing * half;
    b_.Quad(material, {V(x, y, high), V(x, y, low), V(-x, y, low), V(-x, y, high)});
  };
  const MaterialId plate =
      plates_[static_cast<std::size_t>(random_.Integer(0, static_cast<int>(plates_.size()) - 1))];
  const float front = shape.sections.front().y - 0.008F;
  const float back = shape.sections.back().y + 0.008F;
  upright(paint.front, front, -1.0F, nose.half_width - 0.05F, nose.low + 0.06F, nose.high);
  upright(paint.rear, back, 1.0F, tail.half_width - 0.04F, tail.low + 0.08F, tail.high);
  upright(plate, front - 0.008F, -1.0F, 0.26F, 0.36F, 0.47F);
  upright(plate, back + 0.008F, 1.0F, 0.26F, 0.56F, 0.67F);
  const float half = shape.sections[3].half_width + 0.004F;
  const float pillar = shape.foot_from + shape.pillar * (shape.foot_to - shape.foot_from);
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * half;
    for (const float y : {shape.foot_from + 0.22F, pillar, shape.rear_axle - 0.28F}) {
      b_.Quad(black_, {V(x, y - 0.006F, 0.90F), V(x, y - 0.006F, 0.30F), V(x, y + 0.006F, 0.30F),
                       V(x, y + 0.006F, 0.90F)});
    }
    b_.Quad(black_, {V(x, shape.front_axle, 0.36F), V(x, shape.front_axle, 0.26F),
                     V(x, shape.rear_axle, 0.26F), V(x, shape.rear_axle, 0.36F)});
    b_.Box(chrome_, {x - 0.012F, pillar - 0.22F, 0.80F}, {x + 0.012F, pillar - 0.06F, 0.83F});
    const float mirror = side * (shape.foot_half + 0.12F);
    const float at = shape.foot_from + 0.36F;
    b_.Box(black_, {mirror - 0.09F, at, shape.foot_z + 0.02F},
           {mirror + 0.09F, at + 0.10F, shape.foot_z + 0.16F});
  }
}

}  // namespace trailcast::sim
