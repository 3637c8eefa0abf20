#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/ids.h"

namespace trailcast::mission {

// What an operator tells robots to do at once.
enum class NowOrder : std::uint8_t {
  kPause = 0,    // stand where it is
  kResume = 1,   // go on, after a pause
  kCancel = 2,   // end what it does, and stand
  kStop = 3,     // stand, also after a restart, until it is released
  kRelease = 4,  // no longer stopped, but paused
  kEnd = 5,      // what it teaches is complete
  kHome = 6,     // end what it does; a server then sends it home, and holds its queue
};

[[nodiscard]] const char* ToString(NowOrder order);  // "pause"

enum class NowWhom : std::uint8_t { kRobot = 0, kOnRoute = 1, kAll = 2 };

// trailcast/now: said again until it is answered.
struct NowCommand {
  AgentId client{};          // who gives it
  std::uint64_t number = 0;  // drawn at random, 1 or more; obeyed once
  NowOrder order = NowOrder::kStop;
  NowWhom whom = NowWhom::kAll;
  std::string name{};    // of the robot, or the route; empty for all
  std::string reason{};  // one line for people; may be empty
  bool relayed = false;  // by a server, for robots that do not hear its client
  bool operator==(const NowCommand&) const = default;
};

// trailcast/now_answers: of each robot that is meant, each time that it hears the command.
struct NowAnswer {
  AgentId agent{};
  AgentId client{};  // whose command it was, and which one
  std::uint64_t number = 0;
  bool refused = false;  // it was not obeyed
  std::string detail{};  // one line for people: how the robot is now, or why not
  bool relayed = false;  // by a server
  bool operator==(const NowAnswer&) const = default;
};

// As a server keeps it.
struct GivenCommand {
  NowCommand command{};
  std::vector<NowAnswer> answers{};  // of the robots, by name
  std::int64_t given_unix_ms = 0;    // by the server's clock
  bool operator==(const GivenCommand&) const = default;
};

}  // namespace trailcast::mission
