#include "services/program/presence.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/text.h"

namespace trailcast::program {
namespace {

exchange::AgentStatus Starting(exchange::AgentStatus status) {
  status.instance = MakeInstance();
  status.mode = exchange::AgentMode::kStarting;
  return status;
}

}  // namespace

Presence::Presence(exchange::RouteExchange& exchange, exchange::AgentStatus status,
                   std::chrono::milliseconds interval)
    : exchange_(exchange),
      status_(Starting(std::move(status))),
      claim_(status_),
      interval_(interval) {}

Result<void> Presence::Claim(const Handler& handle, const std::function<bool()>& stop) {
  Publish();
  const auto deadline = Clock::now() + NameClaim::kListening;
  while (Clock::now() < deadline && !stop()) {
    for (const exchange::Message& message : exchange_.Take(std::chrono::milliseconds(50))) {
      Handle(message);
      handle(message);
      const auto* status = std::get_if<exchange::AgentStatus>(&message);
      if (status == nullptr) continue;
      if (auto seen = claim_.See(*status); !seen) return seen;
    }
    Tick(Clock::now());
  }
  return {};
}

void Presence::Handle(const exchange::Message& message) {
  if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    others_.erase(gone->agent);
    HandleServer(gone->agent, gone->instance, false);
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    if (others_.size() < kMostAgents) others_.insert(status->agent);
    AnswerClaim(*status);
    if (status->role != exchange::AgentRole::kServer) return;
    HandleServer(status->agent, status->instance, status->mode != exchange::AgentMode::kStopped);
  }
}

void Presence::HandleServer(const AgentId& agent, std::uint64_t instance, bool is_there) {
  if (!is_there) {
    servers_.erase({agent, instance});
  } else if (servers_.size() < kMostServers) {
    servers_.emplace(agent, instance);
  }
  const auto of_same = [this](const auto& each) { return each.first == *server_; };
  if (server_ && std::any_of(servers_.begin(), servers_.end(), of_same)) return;
  server_.reset();
  if (!servers_.empty()) server_ = servers_.begin()->first;
}

std::set<AgentId> Presence::servers() const {
  std::set<AgentId> names;
  for (const auto& [agent, instance] : servers_) names.insert(agent);
  return names;
}

void Presence::AnswerClaim(const exchange::AgentStatus& status) {
  using exchange::AgentMode;
  const bool claims = status.agent == status_.agent && status.instance != status_.instance &&
                      status.mode == AgentMode::kStarting;
  if (claims && status_.mode != AgentMode::kStarting) Publish();
}

void Presence::Set(exchange::AgentStatus status) {
  status.agent = status_.agent;
  status.role = status_.role;
  status.instance = status_.instance;
  status.detail = PlainText(status.detail, 200);
  status_ = std::move(status);
}

void Presence::Tick(Clock::time_point now) {
  if (now >= next_ || published_mode_ != status_.mode) Publish();
}

void Presence::Publish() {
  // A status that cannot be handed over is followed by the next one.
  if (exchange_.Publish(status_)) published_mode_ = status_.mode;
  next_ = Clock::now() + std::max(interval_, kForEachAgent * static_cast<int>(others_.size()));
}

exchange::TopicUse WithAgents(exchange::TopicUse use) {
  constexpr exchange::Topic kAgents = exchange::Topic::kAgents;
  if (!use.Writes(kAgents)) use.write.push_back(kAgents);
  if (!use.Hears(kAgents)) use.overhear.push_back(kAgents);
  return use;
}

}  // namespace trailcast::program
