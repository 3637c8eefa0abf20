#pragma once

#include <filesystem>
#include <vector>

#include "services/base/number_table.h"
#include "services/base/result.h"
#include "services/base/time.h"

namespace trailcast::agent {

// Returns the time in seconds with which a row of a file begins. A time more than a hundred years
// off is kInvalidArgument: no clock shows it, and its nanoseconds would overflow.
[[nodiscard]] Result<SensorTime> TimeIn(const NumberRow& row, const std::filesystem::path& file);

// kInvalidArgument means that the rows are too far apart for a drive if they are in seconds.
[[nodiscard]] Result<void> CheckPace(const std::vector<NumberRow>& rows,
                                     const std::filesystem::path& file);

}  // namespace trailcast::agent
