#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// Tells a replay's log in plain words: who followed which route, how it ended, where and why the
// robot was not sure, and the run in figures. The text fits a screen unless `all` is set.
[[nodiscard]] std::string TellStory(const agent::RunLog& log, bool all);

// The same story in parts.
struct Happening {
  std::size_t first = 0;  // rows of the log, first to last
  std::size_t last = 0;
  std::string where;
  std::string text;
};
struct Story {
  std::string who;
  std::string outcome;
  std::string how_far;
  std::vector<std::string> missing;  // lines about what the log lacks
  std::vector<Happening> happened;   // the weightiest, in order
  std::size_t lesser = 0;            // how many others were left out there
  std::vector<std::string> figures;  // a line each
};
[[nodiscard]] Story MakeStory(const agent::RunLog& log, std::size_t most_happenings);

// A statement about one frame, and its subject.
struct Said {
  std::string about;
  std::string text;
};
[[nodiscard]] std::vector<Said> TellFrame(const agent::RunLog& log, std::size_t row);

// Returns "'hall': 17 segments, 14.8 m, taught by scout (webcam 320x240); followed by ...".
[[nodiscard]] std::string WhoFollowedWhat(const agent::RunLog& log);
[[nodiscard]] std::string Outcome(const agent::RunLog& log);

}  // namespace trailcast::explain
