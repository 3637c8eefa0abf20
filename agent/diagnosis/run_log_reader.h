#pragma once

#include <cstddef>
#include <filesystem>

#include "agent/diagnosis/run_log.h"
#include "services/base/result.h"

namespace trailcast::agent {

// What more a file holds is left out, and noted as damage.
struct ReadLimits {
  std::size_t messages = 5'000'000;  // that are frames, or events: a day at 30 frames a second fits
  std::size_t events = 5'000'000;    // that are kept
  std::size_t bytes = std::size_t{2} << 30U;  // of messages
};

// Reads what is whole and notes what is not: a robot that crashed, a disk that was full, a file
// that was cut off still have a story to tell. An error is a file that cannot be opened, or that is
// no replay's log.
[[nodiscard]] Result<RunLog> ReadRunLog(const std::filesystem::path& file,
                                        const ReadLimits& limits = {});

// Reads a log for those who list many: it leaves out what lies between a long log's first frame and
// its last seconds, and what is damaged.
[[nodiscard]] Result<RunLog> ReadRunEnds(const std::filesystem::path& file);

}  // namespace trailcast::agent
