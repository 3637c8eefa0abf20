#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "agent/diagnosis/diagnosis.h"

namespace trailcast::agent {

// Where the logs of runs on duty go.
struct RunLogsOptions {
  std::filesystem::path folder;            // empty: there are none
  std::uint64_t most_bytes = 500'000'000;  // of all of them; a single one has a quarter of that
  double picture_every_s = 0.5;            // 0: none
};

// One part of one lap of a mission.
struct RunOfMission {
  std::string mission;  // its id
  std::uint32_t task = 0;
  std::uint32_t lap = 0;
};

// Makes room for the log of a run, by taking away the oldest ones, and says where it goes: to
// MISSION-TASK-LAP.mcap, with a further number where an earlier one of the same run is there. Other
// files are left alone. The error: nothing can be written there.
[[nodiscard]] Result<DiagnosisOptions> LogFor(const RunLogsOptions& options,
                                              const RunOfMission& run);

}  // namespace trailcast::agent
