#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "services/plot/drawing.h"

namespace trailcast::plot {

// Routes as lines of a railway map: metres along them are to scale, but bends do not show. A place
// is a route's position in `routes` and metres along it.
struct NetworkPicture {
  struct Place {
    std::size_t route = 0;
    double along_m = 0.0;
  };
  enum class Part { kClosed, kBacked, kLimited, kNarrow, kLost };
  struct Marked {
    Part part = Part::kClosed;
    double from_m = 0.0;
    double to_m = 0.0;
  };
  struct Route {
    std::string name{};
    double length_m = 0.0;
    std::vector<Marked> marked{};
  };
  struct Junction {
    Place from{};
    Place to{};
    bool both = false;
    bool used = true;  // drawn dashed if it is not used, or not yet
  };
  struct Name {
    std::string name{};
    Place place{};
  };

  std::vector<Route> routes{};
  std::vector<Junction> junctions{};
  std::vector<Name> names{};
};

// Draws a row for each route, shifted so that the first junction with a row above it is a vertical
// line. A junction of a route with itself is a bow below it. There must be at least one route.
[[nodiscard]] Drawing DrawNetwork(const NetworkPicture& network);

// Returns where each row begins, in metres from the picture's left; the smallest is 0.
[[nodiscard]] std::vector<double> RowStarts(const NetworkPicture& network);

}  // namespace trailcast::plot
