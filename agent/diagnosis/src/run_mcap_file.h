#pragma once

#include <memory>

#include "agent/diagnosis/run_log_file.h"
#include "agent/diagnosis/run_mcap.h"

namespace trailcast::agent {

// The file of a replay's log, made and written by a thread of its own.
class RunMcapFile {
 public:
  // The error is that the file cannot be made.
  [[nodiscard]] static Result<std::unique_ptr<RunMcapFile>> Create(
      const std::filesystem::path& file, double picture_every_s);
  [[nodiscard]] std::uint64_t bytes() const { return file_->bytes(); }

  // If making or writing does not keep up, this waits or, unless `patient`, drops frames; the log
  // says how many.
  void Put(RunMoment moment, bool patient);
  // `last` is never dropped.
  [[nodiscard]] Result<void> Close(RunMoment last);

 private:
  RunMcapFile(std::unique_ptr<RunLogFile> file, double picture_every_s)
      : mcap_(picture_every_s), file_(std::move(file)) {}

  void TellDropped(RunMoment& next) const;

  RunMcap mcap_;  // for the file's thread
  std::unique_ptr<RunLogFile> file_;
  std::size_t dropped_ = 0;  // since the last one that had room
};

}  // namespace trailcast::agent
