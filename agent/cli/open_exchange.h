#pragma once

#include <memory>

#include "agent/cli/command_line.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::cli {

// The DDS exchange that the options describe.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(
    const CommonOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::cli
