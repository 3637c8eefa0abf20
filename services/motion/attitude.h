#pragma once

#include <optional>
#include <string>

namespace trailcast::motion {

// How a body lies in space: a quaternion, as ROS 2 gives it.
struct Attitude {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

// The heading of a body of any attitude: where its x axis points, seen from above. Nothing for
// numbers that are none, or a quaternion of length 0.
[[nodiscard]] std::optional<double> Heading(const Attitude& attitude);
// Why there is none, for people.
[[nodiscard]] std::string WithoutHeading(const Attitude& attitude);

}  // namespace trailcast::motion
