#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "services/network/network.h"

namespace trailcast::network {

// A part of a route, in metres along it.
struct Part {
  std::string route{};
  double from_m = 0.0;
  double to_m = 0.0;
  bool operator==(const Part&) const = default;
};

// A narrow place, where robots cannot pass each other: the parts of routes that lead through it,
// whichever way they are driven.
struct Lane {
  std::vector<Part> parts{};
  bool operator==(const Lane&) const = default;
};

// A robot waits so far before a lane, and who has come no further into it than kBarelyIn_m has
// only stopped late.
inline constexpr double kBeforeLane_m = 0.5;
inline constexpr double kBarelyInLane_m = 0.5;
// It has left a lane so far beyond it.
inline constexpr double kOutOfLane_m = 0.5;
// Beyond a lane so much of the route is as the lane to whoever comes: robots that keep their
// distance find room there, so that nobody has to stand in the lane behind another.
inline constexpr double kRoomBeyondLane_m = 2.0;
// Of two lanes with less than this between one's room and the other, a robot needs both at once.
inline constexpr double kWaitingRoom_m = 1.0;

// A part of a way, and the lanes that a robot needs before it begins it.
struct Leg {
  std::vector<Stretch> stretches{};
  std::set<std::size_t> lanes{};  // positions
  double through_m = 0.0;         // so far along it the last of them ends, with its room
};

// A way cut where a robot waits to be let into lanes. The first leg needs none: it ends before the
// first lane that is not `open`; those that the way begins in, or meets within `ahead_m`, are. Of a
// way that begins before a lane it is empty. Between lanes that it needs for one leg, there is no
// room to wait.
[[nodiscard]] std::vector<Leg> LegsOf(std::span<const Stretch> way, std::span<const Lane> lanes,
                                      const std::set<std::size_t>& open = {}, double ahead_m = 0.0);

// Those that a robot on the first of these stretches, at its beginning, is in, or comes to.
[[nodiscard]] std::set<std::size_t> LanesOn(std::span<const Stretch> way,
                                            std::span<const Lane> lanes);
// Those that it is in, at least so far; who drives there `backwards` comes in at their other ends.
[[nodiscard]] std::set<std::size_t> LanesAt(const Place& place, std::span<const Lane> lanes,
                                            bool backwards = false, double in_m = kBarelyInLane_m);

}  // namespace trailcast::network
