#pragma once

#include <memory>

#include "services/exchange/network_state.h"
#include "services/exchange/route_exchange.h"
#include "services/program/command_line.h"

namespace trailcast::program {

// The DDS exchange that the options describe, with the heartbeat they ask for. Who publishes a
// status (an agent, a server) waits for a network that is not there yet; for others it is
// kUnavailable. `network`, if there is one, is kept up to date by the exchange, in the thread that
// takes from it. With --security the keys are looked through first: errors as LoadMemberKeys has
// them, kInvalidArgument when they are of another name or for a role that may not what `use` names.
// Who is kept out is told in the log.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(
    const CommonOptions& options, const exchange::TopicUse& use,
    std::shared_ptr<exchange::NetworkState> network = nullptr);

// Whether the role of the keys allows `use`; all is allowed without --security. Keys that are wrong
// in other ways are told of by OpenExchange.
[[nodiscard]] bool KeysAllow(const CommonOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::program
