#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/exchange/mirror.h"

namespace trailcast::server {

// Describes whether other servers hold the same routes. It has no clock.
class MirrorWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Two servers differ for a moment with every segment that is taught.
  static constexpr std::chrono::seconds kMoment{15};
  static constexpr std::chrono::seconds kLong{60};

  // Returns lines for the log about changes.
  [[nodiscard]] std::vector<std::string> Look(const exchange::Mirror& mirror, Time now);
  // Returns which servers have held other routes, or been out of reach, for long, or an empty text.
  [[nodiscard]] static std::string Behind(const exchange::Mirror& mirror, Time now);

 private:
  enum class State : std::uint8_t { kNew, kSame, kOther, kGone };
  std::map<AgentId, State> told_;
};

}  // namespace trailcast::server
