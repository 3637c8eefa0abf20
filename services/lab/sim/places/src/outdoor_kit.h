#pragma once

#include <cstdint>
#include <string>

#include "services/base/result.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/buildings.h"
#include "services/lab/sim/looks/paving.h"
#include "services/lab/sim/looks/street_furniture.h"
#include "services/lab/sim/looks/vegetation.h"
#include "services/lab/sim/looks/vehicles.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// Everything from which an outdoor place is built, on one builder.
struct OutdoorKit {
  explicit OutdoorKit(std::uint64_t seed)
      : paving(builder, seed),
        buildings(builder, seed),
        plants(builder, seed),
        vehicles(builder, seed),
        street(builder, seed) {}
  OutdoorKit(const OutdoorKit&) = delete;
  OutdoorKit& operator=(const OutdoorKit&) = delete;

  // Light is not baked out of doors: the sun casts shadows, so cells may be large.
  static constexpr float kCell_m = 12.0F;
  SceneBuilder builder{kCell_m};
  Paving paving;
  Buildings buildings;
  Vegetation plants;
  Vehicles vehicles;
  StreetFurniture street;
  Lighting lighting;
};

// The sun is behind and to the right of a robot that drives along x, so what is ahead is lit.
inline const Eigen::Vector3f kSunBehind = Eigen::Vector3f(-0.50F, -0.28F, 0.82F).normalized();
// The speed and the slip of drives out of doors, on firm ground.
inline constexpr double kOutdoorSpeed_mps = 0.75;

// Returns the finished place: the kit's scene in its light, and the path through it.
[[nodiscard]] Result<Place> FinishOutdoors(OutdoorKit& kit, const std::string& name,
                                           GroundMode ground, Polyline points);

}  // namespace trailcast::sim
