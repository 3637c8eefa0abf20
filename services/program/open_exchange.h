#pragma once

#include <memory>

#include "services/exchange/route_exchange.h"
#include "services/program/command_line.h"

namespace trailcast::program {

// The DDS exchange that the options describe, with the heartbeat they ask for. With --security the
// keys are looked through first: errors as LoadMemberKeys has them, kInvalidArgument when they are
// of another name or for a role that may not what `use` names. Who is kept out is told in the log.
[[nodiscard]] Result<std::unique_ptr<exchange::RouteExchange>> OpenExchange(
    const CommonOptions& options, const exchange::TopicUse& use);

// Whether the role of the keys allows `use`; all is allowed without --security. Keys that are wrong
// in other ways are told of by OpenExchange.
[[nodiscard]] bool KeysAllow(const CommonOptions& options, const exchange::TopicUse& use);

}  // namespace trailcast::program
