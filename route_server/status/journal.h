#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Describes the traffic of a route server for its log: news, not every message.
class Journal {
 public:
  // Strangers can make up names, so beyond this number the one with the oldest news is forgotten.
  static constexpr std::size_t kMostAgents = 4096;

  // Each returns a line for a message that came in or goes out, if it is worth one.
  [[nodiscard]] std::optional<std::string> Received(const exchange::Message& message);
  [[nodiscard]] std::optional<std::string> Sent(const exchange::Message& message);
  [[nodiscard]] std::size_t agents() const { return agents_.size(); }  // present

 private:
  struct Known {
    std::string name;
    std::string revision;
    std::uint32_t told_durable = 0;  // acknowledged segments when that was last reported
  };
  [[nodiscard]] std::string NameOf(const route::RouteKey& key) const;

  std::optional<std::string> On(const exchange::RouteAnnouncement& announcement);
  std::optional<std::string> On(const exchange::AgentStatus& status);
  std::optional<std::string> On(const exchange::AgentGone& gone);
  std::optional<std::string> On(const exchange::Receipt& receipt);
  std::optional<std::string> On(const exchange::NowCommand& command);
  std::optional<std::string> On(const exchange::NowAnswer& answer);

  // Forgets everything rather than hold too much; some lines then appear again.
  [[nodiscard]] Known& KnownOf(const route::RouteKey& key);

  std::map<route::RouteKey, Known> routes_;
  // The agents present, with their instances.
  NewestMap<AgentId, std::uint64_t> agents_{kMostAgents};
  // Reported commands, by client and number, and who answered them, because they are repeated.
  using NowKey = std::pair<AgentId, std::uint64_t>;
  NewestMap<NowKey, bool> commands_{kMostAgents};
  NewestMap<std::pair<AgentId, NowKey>, bool> answers_{kMostAgents};
};

}  // namespace trailcast::server
