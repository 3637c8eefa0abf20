#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_ref.h"

namespace trailcast::mission {

// What a mission consists of, one after the other:
//   follow ROUTE[@REVISION] [FROM..TO] [laps N] [speed F]   metres along the route, either may be
//                                                           missing; F times the taught speed
//   follow ROUTE[@REVISION] backwards [FROM..TO] [speed F]  in reverse gear, from its end, or FROM,
//                                                           down to its beginning, or TO
//   teach ROUTE [TAG ...]    a person drives until it is told to be ended; no tag is called as what
//                            an order begins with
//   turn DEGREES             on the spot, to the left; below 0 to the right
//   wait SECONDS
// as in "follow hall 3..10 speed 0.5 wait 20 teach yard wet gravel". Of a robot that is sent to a
// place they are the way there, of 'follow' and 'turn' alone:
//   goto PLACE [way N] [TURN] FOLLOW ... [because WORDS ...]
// A server that finds another way while it is going sends the same mission with a higher N, and
// why. Where there is none, it ends in
//   wait way                 for such a one
// and before a narrow place it has
//   wait lane                until a server has sent it without
struct Task {
  enum class Kind : std::uint8_t { kFollow, kWait, kTeach, kTurn, kWaitWay, kWaitLane };
  Kind kind = Kind::kFollow;
  route::RouteRef route{};
  double from_m = 0.0;     // where the robot stands at first; 0: at the route's beginning
  double to_m = 0.0;       // where it ends; 0: at the route's end
  bool backwards = false;  // and from its end to its beginning
  std::uint32_t laps = 1;
  double speed_factor = 1.0;
  double wait_s = 0.0;
  double turn_rad = 0.0;            // to the left
  std::vector<std::string> tags{};  // of what is taught, in any order
};

// What the reason of a way begins with that waits before a lane, or has been let in.
inline constexpr std::string_view kWaits = "waits for ";
inline constexpr std::string_view kEnters = "enters ";
// What the detail of a robot begins with that stands and asks to be told another way from where it
// is; or waits for one, as it was told to.
inline constexpr std::string_view kAsksForWay = "waits for a way: ";

// What a robot is going to, beside the way there.
struct Going {
  std::string to{};       // as its sender calls it: one word, up to 96 bytes
  std::uint32_t way = 1;  // which of the ways that it was sent
  std::string because{};  // of the first none
};

// kInvalidArgument, with the word that was not understood and what was expected.
[[nodiscard]] Result<std::vector<Task>> ParseOrders(std::string_view orders);

// How far a robot turns on the spot right before it does that one of these; 0: not at all.
[[nodiscard]] double TurnBefore(std::span<const Task> tasks, std::size_t task);

// None: they are no way to a place, or not understood.
[[nodiscard]] std::optional<Going> GoingIn(std::string_view orders);

// A robot that is on another way than at first says which at the end of its reports' details,
// "re-planned: hall 3..7 was closed (way 2)". 1: the first, or it has not said so.
[[nodiscard]] std::string WithWay(const std::string& detail, std::uint32_t way);
[[nodiscard]] std::uint32_t WayIn(std::string_view detail);
inline constexpr std::size_t kMostOfWay = 20;  // bytes that it makes a detail longer, at most

// Those that they name; none where they are not understood.
[[nodiscard]] std::set<std::string> RoutesIn(std::string_view orders);

// "follow hall 3..10": as ParseOrders takes it, without what is as usual.
[[nodiscard]] std::string ToText(const Task& task);
[[nodiscard]] std::string ToText(std::span<const Task> tasks);
[[nodiscard]] std::string ToText(const Going& going, std::span<const Task> tasks);

}  // namespace trailcast::mission
