#pragma once

#include <dds/dds.h>

#include <string>
#include <vector>

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

}  // namespace trailcast::dds
