#include "services/exchange/publish.h"

#include <optional>
#include <set>

#include "services/exchange/topics.h"

namespace trailcast::exchange {

Result<void> PublishAll(RouteExchange& exchange, std::span<const Message> messages) {
  Result<void> first_error;
  std::set<std::optional<Topic>> blocked;
  for (const Message& message : messages) {
    const std::optional<Topic> topic = TopicOf(message);
    if (blocked.contains(topic)) continue;
    const Result<void> published = exchange.Publish(message);
    if (published) continue;
    if (published.error().code == ErrorCode::kUnavailable) blocked.insert(topic);
    if (first_error) first_error = published;
  }
  return first_error;
}

}  // namespace trailcast::exchange
