#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::server {

// Tells agents that hear only the server what they need to know of the others: how many there are,
// and which names are taken. If two processes claim one name, the one that was there first keeps
// it; if they start together, the one with the smaller instance does. Every claim is published, so
// that the first process can say whether it is still there. It has no clock and no I/O.
class FleetNews {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Claims of names are published at once. The number of agents is published when it has changed by
  // a tenth, or after a while.
  static constexpr std::chrono::milliseconds kClaimsEvery{20};
  static constexpr std::chrono::seconds kNumberEvery{1};
  static constexpr std::chrono::seconds kLittleEvery{10};

  explicit FleetNews(AgentId server) : server_(std::move(server)) {}

  void Handle(const exchange::Message& message);
  // Returns what is to be published now.
  [[nodiscard]] std::optional<exchange::Fleet> Due(Time now);
  // Returns, for the log, names that two running processes share, each once.
  [[nodiscard]] std::vector<std::string> TakeNotes();
  // Returns the present ones for people, or an empty text.
  [[nodiscard]] std::string NameTrouble() const;

 private:
  struct Process {
    std::uint64_t instance = 0;
    bool starting = false;
  };
  struct Claimer {
    Process process;
    std::uint64_t keeps = 0;
  };
  void Hear(const exchange::AgentStatus& status);
  void End(const AgentId& agent, std::uint64_t instance);

  static constexpr std::size_t kMostAgents = 65'536;  // strangers can make up names

  AgentId server_;
  std::map<AgentId, Process> agents_;  // the first process of each name
  std::map<AgentId, Claimer> claims_;  // and a later one, as long as both are there
  std::vector<std::string> notes_;
  bool claims_changed_ = false;
  std::size_t told_agents_ = 0;
  std::optional<Time> told_at_;
};

}  // namespace trailcast::server
