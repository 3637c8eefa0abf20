#include "agent/duty/run_logs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <regex>
#include <system_error>
#include <vector>

#include "services/base/unix_time.h"

namespace trailcast::agent {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kShareOfOne = 4;

struct OldLog {
  fs::path file;
  fs::file_time_type written;
  std::uint64_t bytes = 0;
};

// Returns the oldest first.
std::vector<OldLog> OldLogs(const fs::path& folder) {
  static const std::regex name(".+-[0-9]+-[0-9]+(-[0-9]+)?\\.mcap");
  std::vector<OldLog> logs;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code gone;
    if (!std::regex_match(entry->path().filename().string(), name)) continue;
    if (!fs::is_regular_file(entry->symlink_status(gone))) continue;
    OldLog log{entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (!gone) logs.push_back(std::move(log));
  }
  std::sort(logs.begin(), logs.end(),
            [](const OldLog& a, const OldLog& b) { return a.written < b.written; });
  return logs;
}

void MakeRoom(const fs::path& folder, std::uint64_t most_bytes) {
  const auto logs = OldLogs(folder);
  std::uint64_t bytes = 0;
  for (const OldLog& log : logs) bytes += log.bytes;
  for (auto log = logs.begin(); log != logs.end() && bytes > most_bytes; ++log) {
    std::error_code stays;
    if (fs::remove(log->file, stays)) bytes -= log->bytes;
  }
}

fs::path NewFile(const RunLogsOptions& options, const RunOfMission& run) {
  const std::string name = fmt::format("{}-{}-{}", run.mission, run.task + 1, run.lap + 1);
  fs::path file = options.folder / (name + ".mcap");
  std::error_code unknown;
  for (int again = 2; fs::exists(file, unknown); ++again) {
    file = options.folder / fmt::format("{}-{}.mcap", name, again);
  }
  return file;
}

}  // namespace

Result<DiagnosisOptions> LogFor(const RunLogsOptions& options, const RunOfMission& run) {
  std::error_code failed;
  fs::create_directories(options.folder, failed);
  if (failed || ::access(options.folder.c_str(), W_OK | X_OK) != 0) {
    return Fail(ErrorCode::kUnavailable,
                "no log of this run is kept: nothing can be written in the folder {}",
                options.folder.string());
  }
  DiagnosisOptions log;
  log.most_log_bytes = options.most_bytes / kShareOfOne;
  log.picture_every_s = options.picture_every_s;
  MakeRoom(options.folder, options.most_bytes - log.most_log_bytes);
  log.log = NewFile(options, run);
  log.header.Add("mission", run.mission);
  log.header.Add("began_unix_ms", std::to_string(NowUnixMs()));
  return log;
}

}  // namespace trailcast::agent
