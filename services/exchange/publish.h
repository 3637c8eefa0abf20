#pragma once

#include <functional>
#include <span>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// Publishes what a Tick returned, in order. A topic that a stalled reader blocks is tried once and
// left for the rest of the call, so that the loop is held up for one write timeout and not for one
// per message; what was left out is asked for again. `published` is told of each message that was
// handed over. The first error, if any.
[[nodiscard]] Result<void> PublishAll(
    RouteExchange& exchange, std::span<const Message> messages,
    const std::function<void(const Message&)>& published = [](const Message&) {});

}  // namespace trailcast::exchange
