#include "services/exchange/servers_there.h"

#include <variant>

namespace trailcast::exchange {

void ServersThere::Handle(const Message& message) {
  if (const auto* gone = std::get_if<AgentGone>(&message)) {
    processes_.erase({gone->agent, gone->instance});
    return;
  }
  const auto* status = std::get_if<AgentStatus>(&message);
  if (status == nullptr || status->role != AgentRole::kServer) return;
  if (status->mode == AgentMode::kStopped) {
    processes_.erase({status->agent, status->instance});
  } else if (processes_.size() < kMost) {
    processes_.emplace(status->agent, status->instance);
  }
}

bool ServersThere::Contains(const AgentId& server) const {
  const auto first = processes_.lower_bound({server, 0});
  return first != processes_.end() && first->first == server;
}

std::set<AgentId> ServersThere::Names() const {
  std::set<AgentId> names;
  for (const auto& [server, instance] : processes_) names.insert(server);
  return names;
}

}  // namespace trailcast::exchange
