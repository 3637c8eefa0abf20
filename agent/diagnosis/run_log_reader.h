#pragma once

#include <filesystem>
#include <istream>

#include "agent/diagnosis/run_log.h"
#include "services/base/result.h"

namespace trailcast::agent {

// What more a file holds is left out, and noted as damage.
struct ReadLimits {
  std::size_t lines = 5'000'000;  // a day at 30 frames a second fits
  std::size_t events = 5'000'000;
  std::size_t text_bytes = std::size_t{2} << 30U;  // of a log as MCAP
};

// Reads what is whole and lists what is not: a robot that crashed, a disk that was full, a file
// that was cut off still have a story to tell. An error is a file that cannot be opened, or that is
// no replay's log of this version. As text or as MCAP.
[[nodiscard]] Result<RunLog> ReadRunLog(const std::filesystem::path& file,
                                        const ReadLimits& limits = {});
[[nodiscard]] Result<RunLog> ReadRunLog(std::istream& stream, const ReadLimits& limits = {});

// The same without what lies between a long log's first and last seconds, for those who list many.
[[nodiscard]] Result<RunLog> ReadRunEnds(const std::filesystem::path& file);

}  // namespace trailcast::agent
