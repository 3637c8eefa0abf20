#pragma once

#include <cstddef>
#include <string>

#include "services/console/runs.h"

namespace trailcast::console {

// These return openapi.yaml's Runs, Run, RunFrames and RunSeen.
[[nodiscard]] std::string RunsBody(const Runs::Page& page);
enum class RunAxis { kMetres, kSeconds };
// It uses metres if the robot has driven some.
[[nodiscard]] std::string RunBody(const OpenedRun& run, RunAxis axis);
inline constexpr std::size_t kMostFramesAtOnce = 100;
[[nodiscard]] std::string RunFramesBody(const OpenedRun& run, std::size_t first);
[[nodiscard]] std::string RunSeenBody(const OpenedRun& run, std::size_t row,
                                      const OpenedRun::Seen& seen);

}  // namespace trailcast::console
