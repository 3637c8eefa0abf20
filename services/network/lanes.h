#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "services/network/network.h"

namespace trailcast::network {

// This is a part of a route, in metres along it.
struct Part {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;
  bool operator==(const Part&) const = default;
};

// This is a mutex zone (a narrow place), where robots cannot pass each other: the parts of routes
// that lead through it, in whichever direction they are driven.
struct Lane {
  std::vector<Part> parts{};
  bool operator==(const Lane&) const = default;
};

// A robot waits this far before a zone. One that is no further inside than kBarelyIn_m has only
// stopped late.
inline constexpr double kBeforeLane_m = 0.5;
inline constexpr double kBarelyInLane_m = 0.5;
// A robot this far beyond a zone has left it.
inline constexpr double kOutOfLane_m = 0.5;
// This much of the route beyond a zone counts as part of it for robots that come. Robots that keep
// their distance find room there, so that none has to stand in the zone behind another.
inline constexpr double kRoomBeyondLane_m = 2.0;
// A robot needs two zones at once if there is less than this between one's room and the other.
inline constexpr double kWaitingRoom_m = 1.0;

// This is a part of a path, and the zones that a robot needs before it begins it.
struct Leg {
  std::vector<Section> sections{};
  std::set<std::size_t> lanes{};  // positions among the zones
  double through_m = 0.0;         // distance along it to the end of the last zone, with its room
};

// Cuts a path where a robot waits to be let into zones. The first leg needs none: it ends before
// the first zone that is not `open`. Zones that the path begins in, or meets within `ahead_m`, are
// open. The leg is empty if the path begins before a zone. There is no room to wait between zones
// that one leg needs.
[[nodiscard]] std::vector<Leg> LegsOf(std::span<const Section> way, std::span<const Lane> lanes,
                                      const std::set<std::size_t>& open = {}, double ahead_m = 0.0);

// Returns the zones that a robot at the beginning of the first section is in, or comes to.
[[nodiscard]] std::set<std::size_t> LanesOn(std::span<const Section> way,
                                            std::span<const Lane> lanes);
// Returns the zones that it is in by at least `in_m`. A robot that drives `backwards` enters them
// at their other ends.
[[nodiscard]] std::set<std::size_t> LanesAt(const Place& place, std::span<const Lane> lanes,
                                            bool backwards = false, double in_m = kBarelyInLane_m);

}  // namespace trailcast::network
