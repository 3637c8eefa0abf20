#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::server {

// What agents that hear the server alone need to know of all others: how many there are, and that a
// name is taken. What two processes say of one name decides the first of them: whoever was there
// before keeps it, and of two that start together the one with the smaller instance. Whether the
// first is there still is asked of it, by telling all who came. No clock, no I/O.
class FleetNews {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Who claims a name is told at once, numbers of agents when they have changed by a tenth, or
  // after a while.
  static constexpr std::chrono::milliseconds kClaimsEvery{20};
  static constexpr std::chrono::seconds kNumberEvery{1};
  static constexpr std::chrono::seconds kLittleEvery{10};

  explicit FleetNews(AgentId server) : server_(std::move(server)) {}

  void Handle(const exchange::Message& message);
  // To be told now.
  [[nodiscard]] std::optional<exchange::Fleet> Due(Time now);
  // For the log: names that two running processes have, each once.
  [[nodiscard]] std::vector<std::string> TakeNotes();
  // For people: the same, as it is now; empty: there are none.
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
  std::map<AgentId, Process> agents_;  // who came to each name first
  std::map<AgentId, Claimer> claims_;  // and who came later, as long as both are there
  std::vector<std::string> notes_;
  bool claims_changed_ = false;
  std::size_t told_agents_ = 0;
  std::optional<Time> told_at_;
};

}  // namespace trailcast::server
