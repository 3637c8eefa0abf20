#pragma once

#include <cstdint>
#include <string>

#include "services/base/ids.h"

namespace trailcast::mission {

// A server waits no longer than this for a robot that is not heard.
inline constexpr std::uint32_t kLongestValid_s = 7 * 24 * 3600;

// This is a message of trailcast/missions: an operator, or a server that keeps the mission, sends a
// robot to do it. It is repeated until it is answered, and a robot carries out the same mission
// once.
struct Mission {
  AgentId agent{};       // the robot that it is for
  std::string id{};      // made by the sender; a name that no other mission of the agent has
  AgentId client{};      // the sender
  std::string orders{};  // one line, see orders.h
  // A server that cannot hand it over within this time drops it. Zero, and whatever is longer, is
  // kLongestValid_s.
  std::uint32_t valid_for_s = 0;
  bool goes_on = false;  // the mission is resumed after its agent has started again
  bool relayed = false;  // by a server
  bool operator==(const Mission&) const = default;
};

enum class State : std::uint8_t {
  kSent = 0,  // a server keeps it, and the robot has not answered
  kAccepted = 1,
  kRefused = 2,   // final, as all states are in which a mission has ended
  kFetching = 3,  // waits for its route, or for the path from there
  kUnderWay = 4,
  kPaused = 5,
  kArrived = 6,
  kFailed = 7,
  kCancelled = 8,
  kExpired = 9,
  // No server takes the mission now, and none keeps it, so its sender sends it again. Reports alone
  // have this state; no mission is kept in it.
  kPutOff = 10,
};
inline constexpr std::uint8_t kStates = 10;  // the states that a mission is kept in

[[nodiscard]] const char* ToString(State state);  // "under way"
[[nodiscard]] bool HasEnded(State state);

// A robot that cannot go on by itself reports what it waits for, also as its mission ends. A server
// reports it of a mission that it keeps.
enum class WaitsFor : std::uint8_t {
  kNothing = 0,
  kWay = 1,   // another path: the robot is off the last one, or at its end
  kLane = 2,  // admission to a narrow place
  kTurn = 3,  // its turn in its robot's queue; `detail` says which mission is before it
  // To know where it is, because it is lost: it looks for itself, or has ended its mission and has
  // to be brought back.
  kPlace = 4,
};

[[nodiscard]] const char* ToString(WaitsFor waits_for);  // "nothing", "path"

// This is a message of trailcast/mission_states. A robot repeats it until a server has relayed it,
// which means that it is durable. A server also reports that it keeps a mission, has dropped it or
// has put it off.
struct Report {
  AgentId agent{};
  std::string mission{};     // its id
  std::uint32_t change = 0;  // counts up from 1 at the robot; 0 is a server's
  State state = State::kSent;
  std::uint32_t task = 0;  // position among its orders
  std::uint32_t way = 1;   // which of the paths to its place (Going) has those orders
  WaitsFor waits_for = WaitsFor::kNothing;
  std::string detail{};  // one line for people: why
  bool relayed = false;  // by a server
  bool operator==(const Report&) const = default;
};

// Returns whether `report` is the later one of the same mission, which has the higher change. A
// server's own report (change 0) counts until the robot reports. At a server, a mission's end is
// later than that it is kept, and of two reports on what it waits for, the last to come is the
// later one.
[[nodiscard]] bool IsNewer(const Report& report, const Report& last);

// This asks a server for missions. Empty fields do not narrow the question.
struct Query {
  std::string agent{};
  std::string route{};  // a route that the orders name
  std::string id{};
  std::string client{};
  std::uint32_t states = 0;        // a bit each, 1 << State; 0 is any
  std::int64_t from_unix_ms = 0;   // sent at that time or later, by the server's clock
  std::int64_t until_unix_ms = 0;  // sent before that time; 0 is now
  std::uint32_t page_size = 50;
  std::uint64_t before = 0;  // where the page before ended
  bool operator==(const Query&) const = default;
};

// This is a mission as a server keeps it.
struct Record {
  Mission mission{};
  Report last{};
  std::int64_t sent_unix_ms = 0;  // by the server's clock, as the next
  std::int64_t changed_unix_ms = 0;
  bool operator==(const Record&) const = default;
};

}  // namespace trailcast::mission
