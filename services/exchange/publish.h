#pragma once

#include <functional>
#include <span>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// Publishes what a Tick returned, in order. `told` is told of each message whether it was handed
// over; what was not, because the link is blocked, goes back to whoever wanted it said (NotSent of
// the protocols). What can never be sent is not told of: it is in the error.
//
// The loop is held up for few write timeouts, not for one per message: of a topic that is blocked
// nothing more is tried, but for segments of other routes, whose readers are others; after
// kMostBlocked of these none. The first error, if any.
inline constexpr int kMostBlocked = 3;
[[nodiscard]] Result<void> PublishAll(
    RouteExchange& exchange, std::span<const Message> messages,
    const std::function<void(const Message&, bool sent)>& told = [](const Message&, bool) {});

}  // namespace trailcast::exchange
