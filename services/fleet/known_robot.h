#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// Returns kNotFound, with the one of `robots` that may have been meant.
[[nodiscard]] Error UnknownRobot(const std::string& name, std::vector<std::string> robots);
// Returns whether a server that gave this reply about the robot has heard of it: it was there, or
// it has taken a mission.
[[nodiscard]] bool HasHeardOf(const exchange::MissionReply& reply, const std::string& robot);

// Listens, and asks servers, until one of them or this program has heard of the robot. If after
// `patience` none has, it returns UnknownRobot; if no server has answered, nothing is known, and it
// returns no error. The exchange needs the agents' and the missions' history topics.
[[nodiscard]] std::optional<Error> FindUnknown(exchange::RouteExchange& exchange,
                                               const AgentId& self, const std::string& robot,
                                               std::chrono::milliseconds patience);

}  // namespace trailcast::fleet
