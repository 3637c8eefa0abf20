#pragma once

#include <chrono>
#include <cstdint>
#include <utility>
#include <variant>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// Asks every server in reach, and repeats the question until one replies, because a server may join
// late. `client` and `request` are those in the question, as a Reply has them. Fails with
// kUnavailable when no server answers within `timeout`, which says how to look further, and with
// what a server says it could not do.
template <typename Reply>
[[nodiscard]] Result<Reply> Ask(exchange::RouteExchange& exchange, const AgentId& client,
                                std::uint64_t request, const exchange::Message& question,
                                std::chrono::milliseconds timeout) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kAskAgain{500};
  constexpr std::chrono::milliseconds kTakeWait{100};
  const auto deadline = Clock::now() + timeout;
  auto ask_at = Clock::now();
  while (Clock::now() < deadline) {
    if (Clock::now() >= ask_at) {
      // A question that could not be sent is repeated, as one that was not answered.
      const Result<void> asked = exchange.Publish(question);
      if (!asked && asked.error().code != ErrorCode::kUnavailable) {
        return tl::unexpected(asked.error());
      }
      ask_at = Clock::now() + kAskAgain;
    }
    for (exchange::Message& message : exchange.Take(kTakeWait)) {
      auto* reply = std::get_if<Reply>(&message);
      if (reply == nullptr || reply->client != client || reply->request != request) continue;
      if (!reply->error.empty()) {
        return Fail(ErrorCode::kUnavailable, "server '{}': {}", reply->server.value(),
                    reply->error);
      }
      return std::move(*reply);
    }
  }
  return Fail(
      ErrorCode::kUnavailable,
      "no route server answered within {:.1f} s: is trailcast-server running, with the same "
      "domain, tag and network interface? With --security: are your keys valid, and not revoked?",
      Seconds(timeout));
}

}  // namespace trailcast::fleet
