#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/told_lately.h"

namespace trailcast::dds {

// What Cyclone warns of in one domain of this process, line by line, instead of on stderr; and what
// it warns of without saying in which. Cyclone writes to one place per process, so all of these
// share it. Lines come from Cyclone's threads;
// Take is for any. Before the domain's first participant is made, so that nothing is missed.
class CycloneLog {
 public:
  explicit CycloneLog(dds_domainid_t domain);
  ~CycloneLog();
  CycloneLog(const CycloneLog&) = delete;
  CycloneLog& operator=(const CycloneLog&) = delete;

  // Since the last call, at most a thousand.
  [[nodiscard]] std::vector<std::string> Take();

 private:
  dds_domainid_t domain_;
};

// Cyclone warns of each packet that it cannot send: lines that differ in numbers alone are told
// once, and counted until they are told again, after ten minutes. No clock.
class CycloneWarnings {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // What is to be told of `line` now; empty: nothing.
  [[nodiscard]] std::string Note(const std::string& line, Time now);

 private:
  ToldLately told_{std::chrono::minutes(10)};
  std::map<std::string, std::uint64_t> untold_;  // by what they have alike
};

}  // namespace trailcast::dds
