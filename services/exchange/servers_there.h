#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// These are the route servers that were heard and have not gone since. Two processes of one name
// count as one, until both have gone. No clock.
class ServersThere {
 public:
  static constexpr std::size_t kMost = 64;  // strangers can make up names

  // Ignores messages that do not tell of a server's coming or going.
  void Handle(const Message& message);
  void Clear() { processes_.clear(); }

  [[nodiscard]] bool empty() const { return processes_.empty(); }
  [[nodiscard]] bool Contains(const AgentId& server) const;
  // Returns each once, in the order of their names.
  [[nodiscard]] std::set<AgentId> Names() const;

 private:
  std::set<std::pair<AgentId, std::uint64_t>> processes_;  // by name and instance
};

}  // namespace trailcast::exchange
