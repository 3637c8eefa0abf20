#pragma once

#include <chrono>
#include <cstdint>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::program {

// Keeps two running processes from using one name. A process that starts publishes its status
// (kStarting) and listens for kListening. The process that was there before keeps the name; if two
// start together, the one with the smaller instance does.
class NameClaim {
 public:
  static constexpr std::chrono::milliseconds kListening{1000};

  // `own` is the published status with its instance.
  explicit NameClaim(const exchange::AgentStatus& own)
      : agent_(own.agent), instance_(own.instance) {}

  // kConflict means that `status` comes from another process that has the name and keeps it.
  [[nodiscard]] Result<void> See(const exchange::AgentStatus& status) const;
  // Does the same by a server's report, for processes that do not hear the other one.
  [[nodiscard]] Result<void> See(const exchange::ClaimedName& claimed) const;

 private:
  [[nodiscard]] Result<void> Refuse(std::uint64_t other) const;

  AgentId agent_;
  std::uint64_t instance_;
};

// Returns a random number, never 0.
[[nodiscard]] std::uint64_t MakeInstance();

}  // namespace trailcast::program
