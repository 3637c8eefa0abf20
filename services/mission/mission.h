#pragma once

#include <cstdint>
#include <string>

#include "services/base/ids.h"

namespace trailcast::mission {

// A robot that was not heard for so long is not waited for.
inline constexpr std::uint32_t kLongestValid_s = 7 * 24 * 3600;

// trailcast/missions: what a robot on duty is sent to do, from an operator, and from servers that
// keep it. Said again until it is answered; the same one is carried out once.
struct Mission {
  AgentId agent{};       // whom it is for
  std::string id{};      // made by the sender; a name, of the agent's missions this one's
  AgentId client{};      // who sends it
  std::string orders{};  // one line: orders.h
  // A server that cannot hand it over by then drops it; 0, and what is longer: kLongestValid_s.
  std::uint32_t valid_for_s = 0;
  bool goes_on = false;  // by itself after its agent has started again
  bool relayed = false;  // by a server
  bool operator==(const Mission&) const = default;
};

enum class State : std::uint8_t {
  kSent = 0,  // a server keeps it, and the robot has not answered
  kAccepted = 1,
  kRefused = 2,   // for good, as all that has ended
  kFetching = 3,  // waits for its route, or the way on
  kUnderWay = 4,
  kPaused = 5,
  kArrived = 6,
  kFailed = 7,
  kCancelled = 8,
  kExpired = 9,
  // No server takes the mission now, and none keeps it: whoever sends it says it again. This is
  // said in reports alone; no mission is kept in this state.
  kPutOff = 10,
};
inline constexpr std::uint8_t kStates = 10;  // those that a mission is kept in

[[nodiscard]] const char* ToString(State state);  // "under way"
[[nodiscard]] bool HasEnded(State state);

// A robot that cannot go on by itself says what it stands and waits for. A server says it of a
// mission that it keeps.
enum class WaitsFor : std::uint8_t {
  kNothing = 0,
  kWay = 1,   // off the way that it was sent last, or at its end: to be told another from there
  kLane = 2,  // before a narrow place: to be let in
  kTurn = 3,  // in its robot's queue: `detail` says for what
};

// trailcast/mission_states: from the robot, said again until a server has said the same (relayed):
// then that is durable. From a server, too, that it keeps one, has dropped it, or has put it off.
struct Report {
  AgentId agent{};
  std::string mission{};  // its id
  std::uint32_t change =
      0;  // counts up from 1 at the robot: the higher is the newer. 0: by a server
  State state = State::kSent;
  std::uint32_t task = 0;  // which of its orders
  std::uint32_t way = 1;   // which of the ways that it was sent to a place (Going) those are of
  WaitsFor waits_for = WaitsFor::kNothing;
  std::string detail{};  // one line for people: why
  bool relayed = false;  // by a server
  bool operator==(const Report&) const = default;
};

// Whether `report` is the later one of the same mission. What a server says itself (change 0)
// counts until the robot's word does. That a mission ends there is later than that it is kept, and
// of two words on what it waits for there, the last to come is the later one.
[[nodiscard]] bool IsNewer(const Report& report, const Report& last);

// Empty fields do not narrow it down.
struct Query {
  std::string agent{};
  std::string route{};  // named in the orders
  std::string id{};
  std::string client{};
  std::uint32_t states = 0;        // a bit each, 1 << State; 0: any
  std::int64_t from_unix_ms = 0;   // sent then or later, by the server's clock
  std::int64_t until_unix_ms = 0;  // and before; 0: now
  std::uint32_t page_size = 50;
  std::uint64_t before = 0;  // beyond the page before
  bool operator==(const Query&) const = default;
};

// As a server keeps it.
struct Record {
  Mission mission{};
  Report last{};
  std::int64_t sent_unix_ms = 0;  // by the server's clock, as the next
  std::int64_t changed_unix_ms = 0;
  bool operator==(const Record&) const = default;
};

}  // namespace trailcast::mission
