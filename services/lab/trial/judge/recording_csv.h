#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// Return the header and one line a replay: first shares for people, then the counts behind them.
[[nodiscard]] std::string RecordingCsvHeader();
[[nodiscard]] std::string RecordingCsvLine(const RecordingRow& row);
[[nodiscard]] Result<void> WriteRecordingCsv(const std::vector<RecordingRow>& rows,
                                             const std::filesystem::path& file);
// Errors name the file, the line, and what was expected there.
[[nodiscard]] Result<std::vector<RecordingRow>> ReadRecordingCsv(const std::filesystem::path& file);
// Says whether the file's first line is that header.
[[nodiscard]] bool IsRecordingCsv(const std::filesystem::path& file);

}  // namespace trailcast::trial
