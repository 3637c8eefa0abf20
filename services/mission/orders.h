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
//   goto PLACE [way N [queued|admitted]] [TURN] FOLLOW ... [because WORDS ...]
// A server that finds another way while it is going sends the same mission with a higher N, and
// why, for people. Where there is none, it ends in
//   wait way                 for such a one
// and before a narrow place it has
//   wait lane                until a server has sent it without: 'admitted'; 'queued' says for whom
//                            it waits until then
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

// What a robot is going to, beside the way there.
struct Going {
  // Why it is sent another way than at first.
  enum class Why : std::uint8_t {
    kReplanned,  // the one before is closed, or the robot was off it, or is to wait on it
    kQueued,     // it waits before a narrow place, and is told for whom
    kAdmitted,   // it is let into it
  };
  std::string to{};       // as its sender calls it: one word, up to 96 bytes
  std::uint32_t way = 1;  // which of the ways that it was sent
  Why why = Why::kReplanned;
  std::string because{};  // for people; of the first none
};

// kInvalidArgument, with the word that was not understood and what was expected.
[[nodiscard]] Result<std::vector<Task>> ParseOrders(std::string_view orders);

// How far a robot turns on the spot right before it does that one of these; 0: not at all.
[[nodiscard]] double TurnBefore(std::span<const Task> tasks, std::size_t task);

// None: they are no way to a place, or not understood.
[[nodiscard]] std::optional<Going> GoingIn(std::string_view orders);

// Those that they name; none where they are not understood.
[[nodiscard]] std::set<std::string> RoutesIn(std::string_view orders);

// "follow hall 3..10": as ParseOrders takes it, without what is as usual.
[[nodiscard]] std::string ToText(const Task& task);
[[nodiscard]] std::string ToText(std::span<const Task> tasks);
[[nodiscard]] std::string ToText(const Going& going, std::span<const Task> tasks);

}  // namespace trailcast::mission
