#pragma once

#include <string>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// A replay's log in plain words: who followed what, how it ended, where and why it was not sure,
// and the run in figures. Fits a screen unless `all` is wanted.
[[nodiscard]] std::string TellStory(const agent::RunLog& log, bool all);

// "'hall': 17 segments, 14.8 m, taught by scout (webcam 320x240); followed by ..."
[[nodiscard]] std::string WhoFollowedWhat(const agent::RunLog& log);
[[nodiscard]] std::string Outcome(const agent::RunLog& log);

}  // namespace trailcast::explain
