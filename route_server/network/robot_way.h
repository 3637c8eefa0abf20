#pragma once

#include <string>
#include <utility>
#include <vector>

#include "services/base/text.h"
#include "services/exchange/bounds.h"
#include "services/mission/orders.h"
#include "services/network/network.h"

namespace trailcast::server {

// A robot's reported place and a beginning or end of its path are the same within this.
inline constexpr double kOnWay_m = 0.5;

[[nodiscard]] inline bool Holds(const network::Section& section, const network::Place& place) {
  const double driven_m = section.DrivenAt(place.along_m);
  return place.route == section.route && driven_m >= -kOnWay_m &&
         driven_m <= section.length_m() + kOnWay_m;
}

// Returns the orders for the robot's next path, with the reason as far as there is room for it. If
// they exceed exchange::kMaxLineBytes, the path has more sections than one mission holds.
[[nodiscard]] inline std::string NextWay(mission::Going going,
                                         const std::vector<mission::Task>& tasks,
                                         mission::Going::Why why, const std::string& because) {
  constexpr std::string_view kBecause = " because ";
  ++going.way;
  going.why = why;
  going.because.clear();
  const std::size_t length = ToText(going, tasks).size() + kBecause.size();
  if (length < exchange::kMaxLineBytes) {
    going.because = PlainText(because, exchange::kMaxLineBytes - length);
  }
  return ToText(going, tasks);
}

}  // namespace trailcast::server
