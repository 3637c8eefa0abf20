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

// A file that grows while the control loop drives. A thread of its own writes it, so that a slow
// disk delays nobody, and passes everything to the system at once. All calls must come from one
// thread.
class RunLogFile {
 public:
  // Returns the next bytes of the file; the file's thread calls it.
  using Make = std::function<bag::Bytes()>;

  // Replaces the file; the error names it. `capacity` is how many parts may wait for the disk.
  [[nodiscard]] static Result<std::unique_ptr<RunLogFile>> Create(const std::filesystem::path& file,
                                                                  std::size_t capacity);
  ~RunLogFile();
  RunLogFile(const RunLogFile&) = delete;
  RunLogFile& operator=(const RunLogFile&) = delete;

  // Adds a part without waiting. Returns false, and leaves `make` untouched, if there is no room
  // because the disk does not keep up.
  [[nodiscard]] bool TryPut(Make&& make) {
    const bool put = waiting_.TryPut(std::move(make));
    bell_.Ring();
    return put;
  }
  // Returns how much was written so far.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_.load(); }
  // Writes everything, and `last` behind it; the error says what was not written.
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
