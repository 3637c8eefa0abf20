#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/trial_report.h"

namespace trailcast::trial {

// Return the header and one line a row. The first columns are a contract, in this order.
[[nodiscard]] std::string TrialCsvHeader();
[[nodiscard]] std::string TrialCsvLine(const TrialRow& row);
[[nodiscard]] Result<void> WriteTrialCsv(const std::vector<TrialRow>& rows,
                                         const std::filesystem::path& file);
// Errors name the file, the line, and what was expected there.
[[nodiscard]] Result<std::vector<TrialRow>> ReadTrialCsv(const std::filesystem::path& file);

}  // namespace trailcast::trial
