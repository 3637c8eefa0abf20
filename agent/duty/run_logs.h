#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "agent/diagnosis/diagnosis.h"

namespace trailcast::agent {

// Where an agent's run logs go.
struct RunLogsOptions {
  std::filesystem::path folder;            // empty for no logs
  std::uint64_t most_bytes = 500'000'000;  // of all logs together; a single one may have a quarter
                                           // of that
  double picture_every_s = 0.5;            // 0 for none
};

// One part of one lap of a mission.
struct RunOfMission {
  std::string mission;  // its id
  std::uint32_t task = 0;
  std::uint32_t lap = 0;
};

// Makes room for a run's log by deleting the oldest ones, and returns its file:
// MISSION-TASK-LAP.mcap, with a further number if an earlier log of the same run exists. Other
// files stay. Error: nothing can be written there.
[[nodiscard]] Result<DiagnosisOptions> LogFor(const RunLogsOptions& options,
                                              const RunOfMission& run);

}  // namespace trailcast::agent
