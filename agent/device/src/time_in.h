#pragma once

#include <filesystem>
#include <vector>

#include "services/base/number_table.h"
#include "services/base/result.h"
#include "services/base/time.h"

namespace trailcast::agent {

// The time in seconds that a row of a file begins with. kInvalidArgument beyond a hundred years
// either way: no clock says so, and nanoseconds would run over.
[[nodiscard]] Result<SensorTime> TimeIn(const NumberRow& row, const std::filesystem::path& file);

// kInvalidArgument where rows lie so far apart in time that they are none of a drive, if they are
// in seconds.
[[nodiscard]] Result<void> CheckPace(const std::vector<NumberRow>& rows,
                                     const std::filesystem::path& file);

}  // namespace trailcast::agent
