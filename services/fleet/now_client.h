#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
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
  std::string detail{};  // its own words
};

// Tells robots what to do now, at once and again until each has answered or `timeout` has passed,
// and returns what they said, by name: each that was named, and, of a route or of all, each
// follower that is heard. kUnavailable where nobody is.
[[nodiscard]] Result<std::vector<RobotsWord>> TellRobots(exchange::RouteExchange& exchange,
                                                         const AgentId& self,
                                                         exchange::NowOrder order,
                                                         const std::vector<NowTarget>& targets,
                                                         const std::string& reason,
                                                         std::chrono::milliseconds timeout);

// A line a robot.
[[nodiscard]] std::string WordsText(const std::vector<RobotsWord>& words);
// For programs: an object, and an array of them.
[[nodiscard]] nlohmann::ordered_json WordJson(const RobotsWord& word);
[[nodiscard]] nlohmann::ordered_json WordsJson(const std::vector<RobotsWord>& words);

}  // namespace trailcast::fleet
