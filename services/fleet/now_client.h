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

// Whom an operator means.
struct NowTarget {
  exchange::NowWhom whom = exchange::NowWhom::kAll;
  std::string name{};  // as NowCommand has it
};

struct RobotsWord {
  std::string robot;
  bool answered = false;
  bool refused = false;
  std::string detail{};  // its own words; of one that did not answer, what is known of it last
  bool known = true;     // false: nobody of this name was ever heard
};

// What became of a command that several robots were given: the worst that became of it anywhere.
enum class Obeyed : std::uint8_t { kByAll, kNotByAll, kUnanswered };
[[nodiscard]] Obeyed ObeyedBy(const std::vector<RobotsWord>& words);

// "last seen 5 s ago, moving at 0.40 m/s"; without the time where it is heard.
[[nodiscard]] std::string LastSeenText(const exchange::AgentStatus& status,
                                       std::optional<std::chrono::milliseconds> ago);
// "last known on its mission 'follow hall', under way", as a server tells of a robot that is not
// heard.
[[nodiscard]] std::string LastKnownText(const mission::Record& record);

// Tells robots what to do now, at once and again until each has answered or `timeout` has passed,
// and returns what they said, by name: each that was named, and, of a route or of all, each
// follower that is heard, and each that a server has on a mission. kUnavailable where nobody is.
[[nodiscard]] Result<std::vector<RobotsWord>> TellRobots(exchange::RouteExchange& exchange,
                                                         const AgentId& self,
                                                         exchange::NowOrder order,
                                                         const std::vector<NowTarget>& targets,
                                                         const std::string& reason,
                                                         std::chrono::milliseconds timeout);

// One sentence on what became of a stop: who stands, and who may be moving.
[[nodiscard]] std::string StandText(const std::vector<RobotsWord>& words);
// A line a robot.
[[nodiscard]] std::string WordsText(const std::vector<RobotsWord>& words);
// For programs: an object, and an array of them.
[[nodiscard]] nlohmann::ordered_json WordJson(const RobotsWord& word);
[[nodiscard]] nlohmann::ordered_json WordsJson(const std::vector<RobotsWord>& words);

}  // namespace trailcast::fleet
