#pragma once

#include <memory>

#include "services/exchange/route_exchange.h"
#include "services/program/command_line.h"

namespace trailcast::fleet {

// This is a member of the network for one command.
struct OperatorPeer {
  AgentId self;
  std::unique_ptr<exchange::RouteExchange> exchange;
};
// Joins under a name of its own, because two operators may be at work at the same time. One process
// may be several members, each with another `number` below 100.
[[nodiscard]] Result<OperatorPeer> JoinAsOperator(const program::CommonOptions& common,
                                                  const exchange::TopicUse& use, int number = 0);

}  // namespace trailcast::fleet
