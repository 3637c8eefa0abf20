#pragma once

#include <memory>

#include "services/exchange/network_state.h"
#include "services/exchange/route_exchange.h"
#include "services/program/command_line.h"

namespace trailcast::program {

// Opens the DDS exchange that the options describe, with their heartbeat. A program that publishes
// a status (an agent, a server) waits for a network that is not there yet; for others that is
// kUnavailable. The exchange keeps `network`, if given, up to date, on the thread that takes from
// it. With --security it checks the keys first: errors are those of LoadMemberKeys, and
// kInvalidArgument if the keys have another name, or a role that may not do what `use` names.
// Participants that are kept out are logged.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(
    const CommonOptions& options, const exchange::TopicUse& use,
    std::shared_ptr<exchange::NetworkState> network = nullptr);

// Says whether the role of the keys allows `use`; without --security everything is allowed.
// OpenExchange reports keys that are wrong in other ways.
[[nodiscard]] bool KeysAllow(const CommonOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::program
