#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/terrain.h"

namespace trailcast::agent {

// The ground that a robot can drive.
struct TerrainLimits {
  std::optional<double> slope_rad{};  // up or down
  std::optional<route::Roughness> roughness{};

  [[nodiscard]] bool any() const { return slope_rad || roughness; }
};

// Checks whether a robot can drive a route, by what was felt of its ground when it was taught.
class TerrainCheck {
 public:
  explicit TerrainCheck(const TerrainLimits& limits) : limits_(limits) {}

  // Says whether all of a route must be checked before it is driven.
  [[nodiscard]] bool any() const { return limits_.any(); }
  // Segments are added in the route's order.
  void Add(const route::Segment& segment);

  // Returns why the robot cannot drive what lies ahead of `from_m`, with the place and the limit,
  // as one line for people; nothing if it can, as far as is known. Without odometry, all of the
  // route lies ahead.
  [[nodiscard]] std::optional<std::string> Refusal(double from_m) const;
  // Returns what has a limit but is not known, and of which segments, as one line for people.
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
