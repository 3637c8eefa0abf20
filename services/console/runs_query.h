#pragma once

#include <cstddef>
#include <string>

namespace trailcast::console {

// These runs are listed. Empty fields match any.
struct RunsQuery {
  std::string robot{};
  std::string route{};
  std::string mission{};
  std::size_t skip = 0;
};

}  // namespace trailcast::console
