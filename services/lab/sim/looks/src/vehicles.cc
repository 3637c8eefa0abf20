#include "services/lab/sim/looks/vehicles.h"

#include <array>
#include <numbers>

#include "services/lab/sim/looks/outdoor_textures.h"

namespace trailcast::sim {
namespace {

using V = Eigen::Vector3f;
using Corners = std::array<V, 4>;

constexpr float kQuarter = std::numbers::pi_v<float> / 2.0F;

// Returns the part of a quadrilateral between shares of its width and height, lifted off it a
// little.
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
  const VehicleSizes& sizes = SizesOf(shape);
  const auto last = static_cast<int>(paints_.size()) - 1;
  const Paint& paint = paints_[static_cast<std::size_t>(random_.Integer(0, last))];
  b_.Place({x, y, 0.0F}, heading_rad + kQuarter);
  Body(sizes, paint);
  Cabin(sizes, paint);
  Wheels(sizes);
  Fittings(sizes, paint);
}

void Vehicles::Body(const VehicleSizes& sizes, const Paint& paint) {
  const auto corner = [](const VehicleSizes::Section& s, float side, float z) -> V {
    return {side * s.half_width, s.y, z};
  };
  for (std::size_t i = 0; i + 1 < sizes.sections.size(); ++i) {
    const VehicleSizes::Section& a = sizes.sections[i];
    const VehicleSizes::Section& c = sizes.sections[i + 1];
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
  const VehicleSizes::Section& nose = sizes.sections.front();
  const VehicleSizes::Section& tail = sizes.sections.back();
  b_.Quad(black_, {corner(nose, -1, nose.high), corner(nose, -1, nose.low),
                   corner(nose, 1, nose.low), corner(nose, 1, nose.high)});
  b_.Quad(black_, {corner(tail, 1, tail.high), corner(tail, 1, tail.low),
                   corner(tail, -1, tail.low), corner(tail, -1, tail.high)});
}

void Vehicles::Cabin(const VehicleSizes& sizes, const Paint& paint) {
  const auto foot = [&](float side, float y) -> V {
    return {side * sizes.cabin_foot.half_width, y, sizes.cabin_foot.z};
  };
  const auto roof = [&](float side, float y) -> V {
    return {side * sizes.roof.half_width, y, sizes.roof.z};
  };
  const Corners windscreen = {roof(-1, sizes.roof.from), foot(-1, sizes.cabin_foot.from),
                              foot(1, sizes.cabin_foot.from), roof(1, sizes.roof.from)};
  const Corners rear = {roof(1, sizes.roof.to), foot(1, sizes.cabin_foot.to),
                        foot(-1, sizes.cabin_foot.to), roof(-1, sizes.roof.to)};
  const Corners right = {roof(1, sizes.roof.from), foot(1, sizes.cabin_foot.from),
                         foot(1, sizes.cabin_foot.to), roof(1, sizes.roof.to)};
  const Corners left = {roof(-1, sizes.roof.to), foot(-1, sizes.cabin_foot.to),
                        foot(-1, sizes.cabin_foot.from), roof(-1, sizes.roof.from)};
  for (const Corners& side : {windscreen, rear, right, left}) {
    b_.Quad(paint.flank, side, {{0.0F, 0.10F}, {0.7F, 0.40F}});
  }
  b_.Quad(paint.flank,
          {roof(-1, sizes.roof.to), roof(-1, sizes.roof.from), roof(1, sizes.roof.from),
           roof(1, sizes.roof.to)},
          {{0.0F, 0.0F}, {0.7F, 0.2F}});
  b_.Quad(glass_, PartOf(windscreen, 0.05F, 0.06F, 0.95F, 0.92F));
  b_.Quad(glass_, PartOf(rear, 0.08F, 0.08F, 0.92F, sizes.rear_side_windows ? 0.9F : 0.5F));
  // On the right the nose is at the left end of the picture, on the left side at its right end.
  const float pillar = sizes.front_doors_end;
  b_.Quad(glass_, PartOf(right, 0.06F, 0.1F, pillar - 0.02F, 0.94F));
  b_.Quad(glass_, PartOf(left, 1.02F - pillar, 0.1F, 0.94F, 0.94F));
  if (!sizes.rear_side_windows) return;
  b_.Quad(glass_, PartOf(right, pillar + 0.02F, 0.1F, 0.92F, 0.94F));
  b_.Quad(glass_, PartOf(left, 0.08F, 0.1F, 0.98F - pillar, 0.94F));
}

void Vehicles::Wheels(const VehicleSizes& sizes) {
  constexpr int kSides = 14;
  const float radius = sizes.wheel_radius;
  const float flank = sizes.half_width();
  for (const float y : {sizes.front_axle, sizes.rear_axle}) {
    for (const float side : {-1.0F, 1.0F}) {
      const V out(side, 0.0F, 0.0F);
      const V hub(side * (flank + 0.012F), y, radius);
      b_.Disc(black_, hub - 0.006F * out + V(0, 0, 0.03F), out, radius + 0.05F, kSides);
      b_.Disc(wheel_, hub, out, radius, kSides);
      b_.Tube(tyre_, hub, hub - 0.22F * out, radius, radius, kSides);
    }
  }
}

void Vehicles::Fittings(const VehicleSizes& sizes, const Paint& paint) {
  const VehicleSizes::Section& nose = sizes.sections[1];
  const VehicleSizes::Section& tail = sizes.sections[sizes.sections.size() - 2];
  const auto upright = [&](MaterialId material, float y, float facing, float half, float low,
                           float high) {
    const float x = facing * half;
    b_.Quad(material, {V(x, y, high), V(x, y, low), V(-x, y, low), V(-x, y, high)});
  };
  const MaterialId plate =
      plates_[static_cast<std::size_t>(random_.Integer(0, static_cast<int>(plates_.size()) - 1))];
  const float front = sizes.sections.front().y - 0.008F;
  const float back = sizes.sections.back().y + 0.008F;
  upright(paint.front, front, -1.0F, nose.half_width - 0.05F, nose.low + 0.06F, nose.high);
  upright(paint.rear, back, 1.0F, tail.half_width - 0.04F, tail.low + 0.08F, tail.high);
  upright(plate, front - 0.008F, -1.0F, 0.26F, 0.36F, 0.47F);
  upright(plate, back + 0.008F, 1.0F, 0.26F, 0.56F, 0.67F);
  const float half = sizes.half_width() + 0.004F;
  const float pillar =
      sizes.cabin_foot.from + sizes.front_doors_end * (sizes.cabin_foot.to - sizes.cabin_foot.from);
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * half;
    for (const float y : {sizes.cabin_foot.from + 0.22F, pillar, sizes.rear_axle - 0.28F}) {
      b_.Quad(black_, {V(x, y - 0.006F, 0.90F), V(x, y - 0.006F, 0.30F), V(x, y + 0.006F, 0.30F),
                       V(x, y + 0.006F, 0.90F)});
    }
    b_.Quad(black_, {V(x, sizes.front_axle, 0.36F), V(x, sizes.front_axle, 0.26F),
                     V(x, sizes.rear_axle, 0.26F), V(x, sizes.rear_axle, 0.36F)});
    b_.Box(chrome_, {x - 0.012F, pillar - 0.22F, 0.80F}, {x + 0.012F, pillar - 0.06F, 0.83F});
    const float mirror = side * (sizes.cabin_foot.half_width + 0.12F);
    const float at = sizes.cabin_foot.from + 0.36F;
    b_.Box(black_, {mirror - 0.09F, at, sizes.cabin_foot.z + 0.02F},
           {mirror + 0.09F, at + 0.10F, sizes.cabin_foot.z + 0.16F});
  }
}

}  // namespace trailcast::sim
