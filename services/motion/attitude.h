#pragma once

#include <optional>
#include <string>

namespace trailcast::motion {

// How a body lies in space, as a quaternion in the form that ROS 2 gives it.
struct Attitude {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

// Returns the heading of a body of any attitude: where its x axis points, seen from above. Numbers
// that are not finite and a quaternion of length 0 have none.
[[nodiscard]] std::optional<double> Heading(const Attitude& attitude);
// Returns, for people, why there is no heading.
[[nodiscard]] std::string WithoutHeading(const Attitude& attitude);

}  // namespace trailcast::motion
