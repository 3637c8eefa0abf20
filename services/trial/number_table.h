#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::trial {

// The numbers under `columns` in a CSV file whose first line names its columns, row by row, in the
// order asked for; other columns are not looked at. Errors name the file, the line, and what was
// expected there.
[[nodiscard]] Result<std::vector<std::vector<double>>> ReadNumbers(
    const std::filesystem::path& file, const std::vector<std::string>& columns);

}  // namespace trailcast::trial
