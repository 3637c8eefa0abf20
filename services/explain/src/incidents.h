#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// An event of a run that is worth a line.
struct Incident {
  std::string kind;       // incidents of the same kind can be merged
  std::size_t first = 0;  // rows of the log, first to last
  std::size_t last = 0;
  double weight = 0.0;  // how much it matters compared with the others
  std::string text;
  int times = 1;
};

// Finds incidents of phases: where the robot was not sure, for how long, and what became of its
// features.
[[nodiscard]] std::vector<Incident> PhaseIncidents(const agent::RunLog& log);
// Finds incidents of segments: hand-overs that found few features, milestones that were overrun.
[[nodiscard]] std::vector<Incident> SegmentIncidents(const agent::RunLog& log);
// Finds incidents of frames: features that were lost at once or disagree, an offset from the path,
// a reduced speed.
[[nodiscard]] std::vector<Incident> FrameIncidents(const agent::RunLog& log);

// Returns all incidents in the order in which they began. Incidents of one kind that follow each
// other closely are merged and have the text of the weightiest.
[[nodiscard]] std::vector<Incident> FindIncidents(const agent::RunLog& log);

}  // namespace trailcast::explain
