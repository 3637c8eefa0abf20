#pragma once

#include <cstddef>
#include <string>

namespace trailcast::console {

// Which runs are listed; empty: any.
struct RunsQuery {
  std::string robot{};
  std::string route{};
  std::string mission{};
  std::size_t skip = 0;
};

}  // namespace trailcast::console
