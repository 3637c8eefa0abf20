#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/exchange/mirror.h"

namespace trailcast::server {

// Whether other servers hold the same routes, in words. No clock.
class MirrorWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Two servers differ for a moment with everything that is taught.
  static constexpr std::chrono::seconds kMoment{15};
  static constexpr std::chrono::seconds kLong{60};

  // Lines for the log, of what has changed.
  [[nodiscard]] std::vector<std::string> Look(const exchange::Mirror& mirror, Time now);
  // Who has held other routes, or been out of reach, for long; or nothing.
  [[nodiscard]] static std::string Behind(const exchange::Mirror& mirror, Time now);

 private:
  enum class State : std::uint8_t { kNew, kSame, kOther, kGone };
  std::map<AgentId, State> told_;
};

}  // namespace trailcast::server
