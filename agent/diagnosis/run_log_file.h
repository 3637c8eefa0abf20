#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "services/base/mailbox.h"
#include "services/base/result.h"

namespace trailcast::agent {

// A text file that grows while the control loop drives: a thread of its own writes it, so that a
// slow disk holds up nobody, and hands it to the system several times a second, so that a crash
// loses less than a second. All calls from one thread.
class RunLogFile {
 public:
  // Replaces the file; the error names it.
  [[nodiscard]] static Result<std::unique_ptr<RunLogFile>> Create(
      const std::filesystem::path& file);
  ~RunLogFile();
  RunLogFile(const RunLogFile&) = delete;
  RunLogFile& operator=(const RunLogFile&) = delete;

  // Never waits. Where the disk does not keep up, texts are dropped; the file says how many.
  void Put(std::string text);
  // Everything is written; the error says what was not.
  [[nodiscard]] Result<void> Close();

 private:
  explicit RunLogFile(std::FILE* stream, std::filesystem::path file);
  void Write();
  void WriteWaiting();

  std::filesystem::path file_;
  std::FILE* stream_;
  Mailbox<std::string> texts_{8192};  // minutes of frames
  std::size_t dropped_ = 0;           // since the last one that found room
  Bell ending_bell_;
  std::atomic<bool> ending_{false};
  bool failed_ = false;  // the thread's until it has ended
  std::thread thread_;
};

}  // namespace trailcast::agent
