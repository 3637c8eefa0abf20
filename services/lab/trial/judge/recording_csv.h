#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// Header and one line a replay: shares for people first, then the counts that they are of.
[[nodiscard]] std::string RecordingCsvHeader();
[[nodiscard]] std::string RecordingCsvLine(const RecordingRow& row);
[[nodiscard]] Result<void> WriteRecordingCsv(const std::vector<RecordingRow>& rows,
                                             const std::filesystem::path& file);
// Errors name the file, the line, and what was expected there.
[[nodiscard]] Result<std::vector<RecordingRow>> ReadRecordingCsv(const std::filesystem::path& file);
// Whether its first line says that it is one.
[[nodiscard]] bool IsRecordingCsv(const std::filesystem::path& file);

}  // namespace trailcast::trial
