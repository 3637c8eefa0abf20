#include "services/exchange/publish.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "services/exchange/topics.h"

namespace trailcast::exchange {
namespace {

// These are blocked together.
using Way = std::pair<std::optional<Topic>, route::RouteKey>;

Way WayOf(const Message& message) {
  const auto* batch = std::get_if<SegmentBatch>(&message);
  const bool of_route = batch != nullptr && !batch->pieces.empty();
  return {TopicOf(message), of_route ? batch->pieces.front().key : route::RouteKey{}};
}

}  // namespace

Result<void> PublishAll(RouteExchange& exchange, std::span<const Message> messages,
                        const std::function<void(const Message&, bool sent)>& told) {
  Result<void> first_error;
  std::set<Way> blocked;
  const auto is_blocked = [&](const Way& way) {
    const auto of_topic = std::count_if(blocked.begin(), blocked.end(),
                                        [&](const Way& each) { return each.first == way.first; });
    return blocked.contains(way) || of_topic == kMostBlocked;
  };
  if (messages.size() > 1) exchange.Gather();
  for (const Message& message : messages) {
    const Way way = WayOf(message);
    if (is_blocked(way)) {
      told(message, false);
      continue;
    }
    const Result<void> done = exchange.Publish(message);
    if (done) {
      told(message, true);
      continue;
    }
    if (done.error().code == ErrorCode::kUnavailable) {
      blocked.insert(way);
      told(message, false);
    }
    if (first_error) first_error = done;
  }
  exchange.Flush();
  return first_error;
}

}  // namespace trailcast::exchange
