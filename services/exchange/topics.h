#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

inline constexpr std::size_t kTopics = static_cast<std::size_t>(Topic::kPhotoRequests) + 1;
// Each topic has a type of message. AgentGone has no topic.
static_assert(std::variant_size_v<AnyMessage> == kTopics + 1);

// Returns the topic a message travels on. It is empty for AgentGone, which is never published.
[[nodiscard]] std::optional<Topic> TopicOf(const Message& message);

// Tells that this topic can be listened to by route: segments, neighbours.
[[nodiscard]] bool IsOfRoutes(Topic topic);

// Returns the route of a message whose topic can be listened to by route, or null for messages of
// other topics.
[[nodiscard]] const route::RouteKey* RouteOf(const Message& message);

// Returns the name on the wire: "trailcast/routes".
[[nodiscard]] const char* NameOf(Topic topic);

// Returns a key that is distinct for each instance of a transient-local topic (routes, receipts,
// agents, fleet), which keeps the latest sample per key. It is empty for messages of the other
// topics.
[[nodiscard]] std::string InstanceOf(const Message& message);

}  // namespace trailcast::exchange
