#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "services/base/ids.h"
#include "services/base/newest_map.h"
#include "services/exchange/messages.h"

namespace trailcast::vda5050 {

// Knows which robots charge, by what route servers say. It does no I/O and has no clock.
class ChargingWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kAskEvery{5};
  // A server's word counts for so long.
  static constexpr std::chrono::seconds kCountsFor{15};
  // Strangers can make up servers: the one that was silent for longest is forgotten.
  static constexpr std::size_t kMostServers = 16;

  explicit ChargingWatch(AgentId self) : self_(std::move(self)) {}

  // Returns the question to publish, if it is due.
  [[nodiscard]] std::optional<exchange::NetworkRequest> Due(Time now);
  void Hear(const exchange::NetworkReply& reply, Time now);
  // Returns a server's words for people, or an empty text if none says that the robot charges.
  [[nodiscard]] std::string WordsOf(const std::string& robot, Time now) const;

 private:
  struct Told {
    Time at{};
    std::map<std::string, std::string> words{};  // of robots that charge
  };

  AgentId self_;
  std::uint64_t request_ = 0;
  Time ask_at_{};
  NewestMap<AgentId, Told> told_{kMostServers};
};

}  // namespace trailcast::vda5050
