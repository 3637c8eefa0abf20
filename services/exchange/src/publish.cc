#include "services/exchange/publish.h"

#include <optional>
#include <set>

#include "services/exchange/topics.h"

namespace trailcast::exchange {

Result<void> PublishAll(RouteExchange& exchange, std::span<const Message> messages,
                        const std::function<void(const Message&)>& published) {
  Result<void> first_error;
  std::set<std::optional<Topic>> blocked;
  for (const Message& message : messages) {
    const std::optional<Topic> topic = TopicOf(message);
    if (blocked.contains(topic)) continue;
    const Result<void> done = exchange.Publish(message);
    if (done) {
      published(message);
      continue;
    }
    if (done.error().code == ErrorCode::kUnavailable) blocked.insert(topic);
    if (first_error) first_error = done;
  }
  return first_error;
}

}  // namespace trailcast::exchange
