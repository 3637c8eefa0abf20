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

// A mission consists of tasks, done one after the other. Its orders have these forms:
//   follow ROUTE[@REVISION] [FROM..TO] [laps N] [speed F]   metres along the route, either may be
//                                                           missing; F times the taught speed
//   follow ROUTE[@REVISION] backwards [FROM..TO] [speed F]  in reverse gear, from its end, or FROM,
//                                                           down to its beginning, or TO
//   teach ROUTE [TAG ...]    a person drives until the robot is told to end; no tag is a word that
//                            an order begins with
//   turn DEGREES             on the spot, to the left; below 0 to the right
//   wait SECONDS
// An example is "follow hall 3..10 speed 0.5 wait 20 teach yard wet gravel". For a robot that is
// sent to a place, the orders are the path there, made of 'follow' and 'turn' alone:
//   goto PLACE [way N [queued|admitted]] [TURN] FOLLOW ... [because WORDS ...]
// A server that finds another path during the mission sends the same mission with a higher N and
// the reason, for people. If there is no path on, the orders end in
//   wait way                 until there is another path
// and before a narrow place they have
//   wait lane                until a server has sent the mission without it ('admitted'); until
//                            then, 'queued' says which robots it waits for
// Before a mission's first order, and after 'goto PLACE [way N ..]', may stand
//   photo [every METRES] [at [NAME=]ROUTE[@REVISION]@METRES ...]   pictures that it takes on its
//   way
struct Task {
  enum class Kind : std::uint8_t { kFollow, kWait, kTeach, kTurn, kWaitWay, kWaitLane };
  Kind kind = Kind::kFollow;
  route::RouteRef route{};
  double from_m = 0.0;     // where it begins; 0 is the route's beginning
  double to_m = 0.0;       // where it ends; 0 is the route's end
  bool backwards = false;  // in reverse gear, with the route's ends exchanged
  std::uint32_t laps = 1;
  double speed_factor = 1.0;
  double wait_s = 0.0;
  double turn_rad = 0.0;            // to the left
  std::vector<std::string> tags{};  // for the taught route, in any order
};

// A place on a route where a robot takes a picture.
struct PhotoPlace {
  std::string name{};  // what people call it; empty if they do not
  route::RouteRef route{};
  double along_m = 0.0;
};

// The pictures that a robot takes on its mission, with at least one place or a distance.
struct PhotoWish {
  // At each multiple of this along each route, from its beginning, so that all missions take
  // theirs at the same places; 0 for none.
  double every_m = 0.0;
  std::vector<PhotoPlace> at{};
  [[nodiscard]] bool any() const { return every_m > 0.0 || !at.empty(); }
};
inline constexpr std::size_t kMostPhotoPlaces = 16;

// As a robot's destination this means the nearest place that is a home, unless a place is called
// so.
inline constexpr std::string_view kHomeWord = "home";

// This is the destination of a robot, without the path to it.
struct Going {
  // This is why it is sent along another path than at first.
  enum class Why : std::uint8_t {
    kReplanned,  // the path before is closed, or the robot was off it or has to wait on it
    kQueued,     // it waits before a narrow place, and is told for which robots
    kAdmitted,   // it is admitted to the narrow place
  };
  std::string to{};       // the sender's name for it: one word, at most 96 bytes
  std::uint32_t way = 1;  // counts the paths that it was sent
  Why why = Why::kReplanned;
  std::string because{};  // for people; empty for the first path
  PhotoWish photos{};     // on its way there
};

// Fails with kInvalidArgument, which has the word that was not understood and what was expected.
[[nodiscard]] Result<std::vector<Task>> ParseOrders(std::string_view orders);

// Returns how far a robot turns on the spot right before that task, or 0 if it does not.
[[nodiscard]] double TurnBefore(std::span<const Task> tasks, std::size_t task);

// Returns nothing for orders that are no path to a place, or are not understood.
[[nodiscard]] std::optional<Going> GoingIn(std::string_view orders);

// Returns what pictures the orders ask for, which are none if they are not understood.
[[nodiscard]] PhotoWish PhotosIn(std::string_view orders);
// Parses "[NAME=]ROUTE[@REVISION]@METRES".
[[nodiscard]] Result<PhotoPlace> ParsePhotoPlace(std::string_view word);

// Returns the routes that the orders name, or none if the orders are not understood.
[[nodiscard]] std::set<std::string> RoutesIn(std::string_view orders);

// Returns orders as ParseOrders takes them, such as "follow hall 3..10", without default values.
[[nodiscard]] std::string ToText(const Task& task);
[[nodiscard]] std::string ToText(std::span<const Task> tasks);
[[nodiscard]] std::string ToText(const Going& going, std::span<const Task> tasks);
[[nodiscard]] std::string ToText(const PhotoPlace& place);
[[nodiscard]] std::string ToText(const PhotoWish& wish);  // "photo every 5 at dock=hall@12"

}  // namespace trailcast::mission
