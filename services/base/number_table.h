#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast {

struct NumberRow {
  int line = 0;  // in the file, from 1; for messages
  std::vector<double> cells;
};

// The numbers, all finite, under `columns` in a CSV file whose first line names its columns, row by
// row, in the order asked for, and then those of `optional` columns that it has; others are not
// looked at. Errors: kNotFound, kInvalidArgument; they name the file, the line, and what was
// expected there.
[[nodiscard]] Result<std::vector<NumberRow>> ReadNumbers(
    const std::filesystem::path& file, const std::vector<std::string>& columns,
    const std::vector<std::string>& optional = {});

}  // namespace trailcast
