#pragma once

#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// Returns a run in figures, one line each, "what   how much", without those that the method or the
// robot does not have.
[[nodiscard]] std::vector<std::string> RunFigures(const agent::RunLog& log);

}  // namespace trailcast::explain
