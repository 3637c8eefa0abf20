#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/terrain.h"

namespace trailcast::agent {

// What ground a robot can drive.
struct TerrainLimits {
  std::optional<double> slope_rad{};  // up or down
  std::optional<route::Roughness> roughness{};

  [[nodiscard]] bool any() const { return slope_rad || roughness; }
};

// Whether a robot can drive a route, by what was felt of its ground when it was taught.
class TerrainCheck {
 public:
  explicit TerrainCheck(const TerrainLimits& limits) : limits_(limits) {}

  // Whether all of a route is to be looked at before it is driven.
  [[nodiscard]] bool any() const { return limits_.any(); }
  // In the route's order.
  void Add(const route::Segment& segment);

  // Why not: what lies ahead of `from_m`, where, and what the limit is; one line for people.
  // Without odometry all of it does. Nothing: it can, as far as is known.
  [[nodiscard]] std::optional<std::string> Refusal(double from_m) const;
  // What has a limit, and of which segments it is not known: one line for people. Nothing: none.
  [[nodiscard]] std::optional<std::string> NotKnown() const;

 private:
  struct Excess {
    double end_m = 0.0;
    bool metric = false;
    std::string what;
  };
  [[nodiscard]] std::string Where(const route::Segment& segment) const;

  TerrainLimits limits_;
  double length_m_ = 0.0;
  int segments_ = 0;
  int slope_not_known_ = 0;
  int roughness_not_known_ = 0;
  std::vector<Excess> excesses_;
};

}  // namespace trailcast::agent
