#pragma once

#include <cstdint>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"
#include "services/lab/sim/looks/vehicle_shape.h"

namespace trailcast::sim {

// Builds parked vehicles: bodies with windows, wheels, lamps and number plates.
class Vehicles {
 public:
  // Keeps a reference to `builder`. The same seed gives the same colours and plates.
  Vehicles(SceneBuilder& builder, std::uint64_t seed);

  // Parks a vehicle with its middle at (x, y) and its nose towards `heading_rad`.
  void Park(float x, float y, float heading_rad, VehicleShape shape);
  // Parks a car of any shape except the van's.
  void ParkAny(float x, float y, float heading_rad);

 private:
  struct Paint {
    MaterialId flank, front, rear;
  };

  void Body(const VehicleSizes& sizes, const Paint& paint);
  void Cabin(const VehicleSizes& sizes, const Paint& paint);
  void Wheels(const VehicleSizes& sizes);
  void Fittings(const VehicleSizes& sizes, const Paint& paint);

  SceneBuilder& b_;
  Random random_;
  std::vector<Paint> paints_;
  std::vector<MaterialId> plates_;
  MaterialId glass_, black_, tyre_, wheel_, chrome_;
};

}  // namespace trailcast::sim
