#include "route_server/routes/request_queue.h"

#include <algorithm>
#include <utility>

#include "services/base/process_name.h"

namespace trailcast::server {
namespace {

using exchange::CatalogRequest;
using exchange::Message;

// A client without an answer repeats its question: to the catalog under a new number, otherwise
// under the same.
bool IsSameAgain(const Message& request, const Message& before) {
  const auto* query = std::get_if<CatalogRequest>(&request);
  const auto* query_before = std::get_if<CatalogRequest>(&before);
  if (query == nullptr || query_before == nullptr) return request == before;
  return query->client == query_before->client && query->query == query_before->query;
}

}  // namespace

AgentId MemberOf(const Message& request) {
  const auto client = [&]() -> const AgentId& {
    if (const auto* query = std::get_if<CatalogRequest>(&request)) return query->client;
    if (const auto* edit = std::get_if<exchange::RouteEditRequest>(&request)) return edit->client;
    if (const auto* edit = std::get_if<exchange::NetworkEdit>(&request)) return edit->client;
    if (const auto* query = std::get_if<exchange::NetworkRequest>(&request)) return query->client;
    if (const auto* query = std::get_if<exchange::MissionRequest>(&request)) return query->client;
    return std::get<mission::Mission>(request).client;
  };
  return AgentId(WithoutProcess(client().value()));
}

Result<void> RequestQueue::Add(const Message& request) {
  const AgentId member = MemberOf(request);
  if (const auto found = waiting_.find(member); found != waiting_.end()) {
    std::deque<Message>& its = found->second;
    const auto same = std::find_if(its.begin(), its.end(), [&](const Message& before) {
      return IsSameAgain(request, before);
    });
    if (same != its.end()) {
      *same = request;
      return {};
    }
    if (its.size() >= kMostOfAMember) {
      return Fail(ErrorCode::kUnavailable,
                  "{} requests of '{}' wait here already: ask again when they are answered",
                  its.size(), member.value());
    }
  }
  if (size_ >= kMost) {
    return Fail(ErrorCode::kUnavailable, "busy: {} requests wait here; ask again later", size_);
  }
  waiting_[member].push_back(request);
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

std::vector<mission::Mission> RequestQueue::TakeMissions() {
  std::vector<mission::Mission> missions;
  for (auto& [member, its] : waiting_) {
    size_ -= std::erase_if(its, [&](const Message& request) {
      const auto* mission = std::get_if<mission::Mission>(&request);
      if (mission != nullptr) missions.push_back(*mission);
      return mission != nullptr;
    });
  }
  std::erase_if(waiting_, [](const auto& each) { return each.second.empty(); });
  return missions;
}

}  // namespace trailcast::server
