#include "route_server/routes/request_queue.h"

#include <algorithm>
#include <utility>

namespace trailcast::server {
namespace {

using exchange::CatalogRequest;
using exchange::Message;
using exchange::NetworkEdit;
using exchange::NetworkRequest;
using exchange::RouteEditRequest;

// A client that heard no answer asks the same again, of the catalog under a new number; an edit has
// the number that it had.
bool IsSameAgain(const Message& request, const Message& before) {
  const auto* query = std::get_if<CatalogRequest>(&request);
  const auto* query_before = std::get_if<CatalogRequest>(&before);
  if (query == nullptr || query_before == nullptr) return request == before;
  return query->query == query_before->query;
}

}  // namespace

const AgentId& ClientOf(const Message& request) {
  if (const auto* query = std::get_if<CatalogRequest>(&request)) return query->client;
  if (const auto* edit = std::get_if<RouteEditRequest>(&request)) return edit->client;
  if (const auto* edit = std::get_if<NetworkEdit>(&request)) return edit->client;
  return std::get<NetworkRequest>(request).client;
}

Result<void> RequestQueue::Add(const Message& request) {
  const AgentId& client = ClientOf(request);
  if (const auto found = waiting_.find(client); found != waiting_.end()) {
    std::deque<Message>& its = found->second;
    const auto same = std::find_if(its.begin(), its.end(), [&](const Message& before) {
      return IsSameAgain(request, before);
    });
    if (same != its.end()) {
      *same = request;
      return {};
    }
    if (its.size() >= kMostOfAClient) {
      return Fail(ErrorCode::kUnavailable,
                  "{} requests of '{}' wait here already: ask again when they are answered",
                  its.size(), client.value());
    }
  }
  if (size_ >= kMost) {
    return Fail(ErrorCode::kUnavailable, "busy: {} requests wait here; ask again later", size_);
  }
  waiting_[client].push_back(request);
  ++size_;
  return {};
}

std::optional<Message> RequestQueue::Next() {
  if (empty()) return std::nullopt;
  auto next = waiting_.upper_bound(served_last_);
  if (next == waiting_.end()) next = waiting_.begin();
  served_last_ = next->first;
  Message request = std::move(next->second.front());
  next->second.pop_front();
  --size_;
  if (next->second.empty()) waiting_.erase(next);
  return request;
}

}  // namespace trailcast::server
