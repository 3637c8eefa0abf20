#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "services/bag/compression.h"
#include "services/base/mailbox.h"
#include "services/base/result.h"

namespace trailcast::agent {

// A file that grows while the control loop drives: a thread of its own writes it, so that a slow
// disk holds up nobody, and hands it to the system at once. All calls from one thread.
class RunLogFile {
 public:
  // What comes next into the file; called by its thread.
  using Make = std::function<bag::Bytes()>;

  // Replaces the file; the error names it. `capacity`: how much may wait for the disk.
  [[nodiscard]] static Result<std::unique_ptr<RunLogFile>> Create(const std::filesystem::path& file,
                                                                  std::size_t capacity);
  ~RunLogFile();
  RunLogFile(const RunLogFile&) = delete;
  RunLogFile& operator=(const RunLogFile&) = delete;

  // Never waits. False, with `make` untouched: there is no room, since the disk does not keep up.
  [[nodiscard]] bool TryPut(Make&& make) {
    const bool put = waiting_.TryPut(std::move(make));
    bell_.Ring();
    return put;
  }
  // Written so far.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_.load(); }
  // Everything is written, `last` behind it; the error says what was not.
  [[nodiscard]] Result<void> Close(const Make& last = [] { return bag::Bytes(); });

 private:
  RunLogFile(std::FILE* stream, std::filesystem::path file, std::size_t capacity);
  void Write();
  void WriteUntilItEnds();
  void WriteBytes(const bag::Bytes& bytes);
  void WriteWaiting();

  std::filesystem::path file_;
  std::FILE* stream_;
  Mailbox<Make> waiting_;
  Bell bell_;
  std::atomic<bool> ending_{false};
  std::atomic<std::uint64_t> bytes_{0};
  bool failed_ = false;  // the thread's until it has ended
  std::thread thread_;
};

}  // namespace trailcast::agent
