#pragma once

#include <functional>
#include <span>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// Publishes what a Tick returned, in order, and calls `told` for each message with whether it was
// handed over. A message that was not, because the link is blocked, goes back to its protocol
// (NotSent). `told` does not hear of messages that can never be sent; the returned error has the
// first of these.
//
// Few write timeouts hold up the loop, not one per message. Nothing more is tried on a topic that
// is blocked, except segments of other routes, which have other readers. After kMostBlocked of
// these, none is tried.
inline constexpr int kMostBlocked = 3;
[[nodiscard]] Result<void> PublishAll(
    RouteExchange& exchange, std::span<const Message> messages,
    const std::function<void(const Message&, bool sent)>& told = [](const Message&, bool) {});

}  // namespace trailcast::exchange
