#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/looks/paving.h"
#include "services/lab/sim/looks/vehicles.h"

namespace trailcast::sim {

// Painted bays side by side, some of them with a car.
class ParkingRows {
 public:
  static constexpr float kBayWidth_m = 2.5F;
  static constexpr float kBayLength_m = 5.0F;

  struct Row {
    Eigen::Vector2f corner = {0.0F, 0.0F};  // the row's least x and y
    bool along_x = true;                    // or along y
    int bays = 1;
    float nose = 0.0F;   // heading of most cars; some were parked backwards
    double share = 0.7;  // share of the bays that are taken
  };

  ParkingRows(Paving& paving, Vehicles& vehicles, std::uint64_t seed)
      : paving_(paving), vehicles_(vehicles), random_(seed, "parking") {}

  void Fill(const Row& row);

 private:
  Paving& paving_;
  Vehicles& vehicles_;
  Random random_;
};

}  // namespace trailcast::sim
