#pragma once

#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// A run in figures, one line each, "what   how much"; only those that the method and the robot
// have.
[[nodiscard]] std::vector<std::string> RunFigures(const agent::RunLog& log);

}  // namespace trailcast::explain
