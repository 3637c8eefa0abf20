#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

inline constexpr std::size_t kTopics = static_cast<std::size_t>(Topic::kStores) + 1;
// Each has a type of message; AgentGone has no topic.
static_assert(std::variant_size_v<AnyMessage> == kTopics + 1);

// The topic a message travels on; empty for AgentGone, which no one publishes.
[[nodiscard]] std::optional<Topic> TopicOf(const Message& message);

// One may listen to it by route: segments, neighbours.
[[nodiscard]] bool IsOfRoutes(Topic topic);

// The route that a message of a topic is about to which one listens by route; null for
// messages of other topics.
[[nodiscard]] const route::RouteKey* RouteOf(const Message& message);

// As on the wire: "trailcast/routes".
[[nodiscard]] const char* NameOf(Topic topic);

// Distinct for each instance of a transient-local topic (routes, receipts, agents, fleet), which
// keep the latest sample per key; empty for messages of the other topics.
[[nodiscard]] std::string InstanceOf(const Message& message);

}  // namespace trailcast::exchange
