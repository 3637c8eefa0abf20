#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// Something in a run that is worth a line.
struct Incident {
  std::string kind;       // what can be merged with what
  std::size_t first = 0;  // rows of the log, first to last
  std::size_t last = 0;
  double weight = 0.0;  // how much it matters beside the others
  std::string text;
  int times = 1;
};

// Of the phases: where the robot was not sure, for how long, and what became of its features.
[[nodiscard]] std::vector<Incident> PhaseIncidents(const agent::RunLog& log);
// Of the segments: hand-overs that found little, milestones driven past.
[[nodiscard]] std::vector<Incident> SegmentIncidents(const agent::RunLog& log);
// Of the frames: features lost at once or disagreeing, a place beside the path, a speed held back.
[[nodiscard]] std::vector<Incident> FrameIncidents(const agent::RunLog& log);

// All of them, in the order in which they began; those of one kind that follow each other closely
// are one, with the text of the weightiest.
[[nodiscard]] std::vector<Incident> FindIncidents(const agent::RunLog& log);

}  // namespace trailcast::explain
