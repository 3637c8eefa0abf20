#pragma once

#include <filesystem>
#include <istream>

#include "agent/diagnosis/run_log.h"
#include "services/base/result.h"

namespace trailcast::agent {

// Reads what is whole and lists what is not: a robot that crashed, a disk that was full, a file
// that was cut off still have a story to tell. An error is a file that cannot be opened, or that is
// no replay's log of this version. As text or as MCAP.
[[nodiscard]] Result<RunLog> ReadRunLog(const std::filesystem::path& file);
[[nodiscard]] Result<RunLog> ReadRunLog(std::istream& stream);

}  // namespace trailcast::agent
