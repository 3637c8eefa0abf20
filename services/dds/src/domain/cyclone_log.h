#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/told_lately.h"

namespace trailcast::dds {

// Collects Cyclone's warnings in one domain of this process, and those without a domain, instead of
// writing them to stderr. Cyclone has one log per process, so all instances share it. Lines come
// from Cyclone's threads; any thread may call Take. It must exist before the domain's first
// participant, to miss nothing.
class CycloneLog {
 public:
  explicit CycloneLog(dds_domainid_t domain);
  ~CycloneLog();
  CycloneLog(const CycloneLog&) = delete;
  CycloneLog& operator=(const CycloneLog&) = delete;

  // Returns at most a thousand lines since the last call.
  [[nodiscard]] std::vector<std::string> Take();

 private:
  dds_domainid_t domain_;
};

// Thins out Cyclone's warnings, of which there is one for each packet that cannot be sent. Lines
// that differ only in numbers are reported once and counted until they are reported again, after
// ten minutes. It has no clock.
class CycloneWarnings {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Returns what is to be reported for `line` now, which may be empty.
  [[nodiscard]] std::string Note(const std::string& line, Time now);

 private:
  ToldLately told_{std::chrono::minutes(10)};
  std::map<std::string, std::uint64_t> untold_;  // by the part that lines have in common
};

}  // namespace trailcast::dds
