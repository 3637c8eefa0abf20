#pragma once

#include <cstddef>
#include <filesystem>

#include "agent/diagnosis/run_log.h"
#include "services/base/result.h"

namespace trailcast::agent {

// Anything beyond these is left out, and noted as damage.
struct ReadLimits {
  std::size_t messages = 5'000'000;  // frames, or events; enough for a day at 30 frames a second
  std::size_t events = 5'000'000;    // that are kept
  std::size_t bytes = std::size_t{2} << 30U;  // of all messages
};

// Reads the whole parts and notes the damaged ones, because a log of a robot that crashed, of a
// full disk, or that was cut off still tells a story. An error is a file that cannot be opened, or
// that is no replay's log.
[[nodiscard]] Result<RunLog> ReadRunLog(const std::filesystem::path& file,
                                        const ReadLimits& limits = {});

// Reads a log for a list of many: it leaves out everything between a long log's first frame and its
// last seconds, and damage.
[[nodiscard]] Result<RunLog> ReadRunEnds(const std::filesystem::path& file);

}  // namespace trailcast::agent
