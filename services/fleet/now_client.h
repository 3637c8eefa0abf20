#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// This is whom an operator commands.
struct NowTarget {
  exchange::NowWhom whom = exchange::NowWhom::kAll;
  std::string name{};  // as NowCommand has it
};

struct RobotsWord {
  std::string robot;
  bool answered = false;
  bool refused = false;
  std::string detail{};  // its own words or, if it did not answer, what was last known of it
  bool known = true;     // false if no robot of this name was ever heard
};

// This is the outcome of a command to several robots: the worst of them.
enum class Obeyed : std::uint8_t { kByAll, kNotByAll, kUnanswered };
[[nodiscard]] Obeyed ObeyedBy(const std::vector<RobotsWord>& words);

// Returns "last seen 5 s ago, moving at 0.40 m/s", without the time if the robot is heard.
[[nodiscard]] std::string LastSeenText(const exchange::AgentStatus& status,
                                       std::optional<std::chrono::milliseconds> ago);
// Returns "last known on its mission 'follow hall', under way", as a server tells of a robot that
// is not heard.
[[nodiscard]] std::string LastKnownText(const mission::Record& record);

// Commands robots at once, and repeats it until each has answered or `timeout` has passed. Returns
// what they said, by name: each robot that was named and, for a route or for all, each follower
// that is heard, and each that a server has on a mission. Fails with kUnavailable if there is none.
[[nodiscard]] Result<std::vector<RobotsWord>> TellRobots(exchange::RouteExchange& exchange,
                                                         const AgentId& self,
                                                         exchange::NowOrder order,
                                                         const std::vector<NowTarget>& targets,
                                                         const std::string& reason,
                                                         std::chrono::milliseconds timeout);

// Returns one sentence on the outcome of a stop: which robots stand, and which may be moving.
[[nodiscard]] std::string StandText(const std::vector<RobotsWord>& words);
// Returns one line for each robot.
[[nodiscard]] std::string WordsText(const std::vector<RobotsWord>& words);
// These return an object, and an array of objects, for programs.
[[nodiscard]] nlohmann::ordered_json WordJson(const RobotsWord& word);
[[nodiscard]] nlohmann::ordered_json WordsJson(const std::vector<RobotsWord>& words);

}  // namespace trailcast::fleet
