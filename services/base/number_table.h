#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast {

struct NumberRow {
  int line = 0;  // in the file, from 1, for messages
  std::vector<double> cells;
};

// Reads a CSV file whose first line names its columns. Each row has the numbers, all finite, under
// `columns` in the order asked for, and then those under the `optional` columns that the file has.
// Other columns are ignored. Errors: kNotFound, kInvalidArgument; they name the file, the line, and
// what was expected there.
[[nodiscard]] Result<std::vector<NumberRow>> ReadNumbers(
    const std::filesystem::path& file, const std::vector<std::string>& columns,
    const std::vector<std::string>& optional = {});

}  // namespace trailcast
