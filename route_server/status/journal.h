#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::server {

// Puts the traffic of a route server into words for its log: what is new, not every message.
class Journal {
 public:
  // Strangers can make up names: beyond it the one is forgotten that was not heard of for longest.
  static constexpr std::size_t kMostAgents = 4096;

  // A message that came in, or one that goes out: a line, or nothing worth one.
  [[nodiscard]] std::optional<std::string> Received(const exchange::Message& message);
  [[nodiscard]] std::optional<std::string> Sent(const exchange::Message& message);
  [[nodiscard]] std::size_t agents() const { return agents_.size(); }  // present

 private:
  struct Known {
    std::string name;
    std::string revision;
    std::uint32_t told_durable = 0;  // segments receipted, when that was last told
  };
  [[nodiscard]] std::string NameOf(const route::RouteKey& key) const;

  std::optional<std::string> On(const exchange::RouteAnnouncement& announcement);
  std::optional<std::string> On(const exchange::AgentStatus& status);
  std::optional<std::string> On(const exchange::AgentGone& gone);
  std::optional<std::string> On(const exchange::Receipt& receipt);
  std::optional<std::string> On(const exchange::NowCommand& command);
  std::optional<std::string> On(const exchange::NowAnswer& answer);

  // Forgets all rather than hold too many: then it tells of some again.
  [[nodiscard]] Known& KnownOf(const route::RouteKey& key);

  std::map<route::RouteKey, Known> routes_;
  // Present, with their instances.
  NewestMap<AgentId, std::uint64_t> agents_{kMostAgents};
  // Told: commands, by client and number, and who answered them. They are said again and again.
  using NowKey = std::pair<AgentId, std::uint64_t>;
  NewestMap<NowKey, bool> commands_{kMostAgents};
  NewestMap<std::pair<AgentId, NowKey>, bool> answers_{kMostAgents};
};

}  // namespace trailcast::server
