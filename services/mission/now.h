#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/ids.h"

namespace trailcast::mission {

// This is what an operator tells robots to do at once.
enum class NowOrder : std::uint8_t {
  kPause = 0,    // stops where it is
  kResume = 1,   // goes on after a pause
  kCancel = 2,   // ends its mission and stops
  kStop = 3,     // stays stopped, over restarts, until it is released
  kRelease = 4,  // is paused instead of stopped
  kEnd = 5,      // completes the route that it teaches
  kHome = 6,     // ends its mission; a server then sends it home, and holds its queue
};

[[nodiscard]] const char* ToString(NowOrder order);  // "pause"

enum class NowWhom : std::uint8_t { kRobot = 0, kOnRoute = 1, kAll = 2 };

// This is a message of trailcast/now, repeated until it is answered.
struct NowCommand {
  AgentId client{};          // the sender
  std::uint64_t number = 0;  // drawn at random, at least 1; a robot obeys each once
  NowOrder order = NowOrder::kStop;
  NowWhom whom = NowWhom::kAll;
  std::string name{};    // a robot's or a route's; empty for all
  std::string reason{};  // one line for people; may be empty
  bool relayed = false;  // by a server, for robots that do not hear its client
  bool operator==(const NowCommand&) const = default;
};

// This is a message of trailcast/now_answers. Each robot that a command addresses sends one each
// time that it receives the command.
struct NowAnswer {
  AgentId agent{};
  AgentId client{};  // the command's sender; `number` says which command
  std::uint64_t number = 0;
  bool refused = false;  // the command was not obeyed
  std::string detail{};  // one line for people: the robot's state, or why it did not obey
  bool relayed = false;  // by a server
  bool operator==(const NowAnswer&) const = default;
};

// This is a command as a server keeps it.
struct GivenCommand {
  NowCommand command{};
  std::vector<NowAnswer> answers{};  // sorted by the robots' names
  std::int64_t given_unix_ms = 0;    // by the server's clock
  bool operator==(const GivenCommand&) const = default;
};

}  // namespace trailcast::mission
