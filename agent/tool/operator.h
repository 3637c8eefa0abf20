#pragma once

#include <chrono>
#include <memory>

#include "agent/cli/command_line.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::tool {

// The name under which this process asks: two operators may do so at the same time.
[[nodiscard]] AgentId OperatorName(const cli::CommonOptions& common);
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenAsOperator(
    const cli::CommonOptions& common, const AgentId& name);

[[nodiscard]] std::chrono::milliseconds Milliseconds(double seconds);

}  // namespace trailcast::tool
