#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::demo {

// How a process ended.
struct ExitStatus {
  int code = 0;    // what it returned
  int signal = 0;  // or the signal that ended it; 0 if none did
  [[nodiscard]] bool ok() const { return code == 0 && signal == 0; }
};
[[nodiscard]] std::string ToString(const ExitStatus& status);

// A child process. It is ended when this object goes and, by the kernel, when our own process dies
// in any way. It has a process group of its own, so that Ctrl-C reaches only us and we end it in
// order. It must be started from the main thread, because the kernel watches the thread that
// started it.
class ChildProcess {
 public:
  // Starts a program; argv[0] is its path. stdout and stderr go to `log`, and stdin is empty.
  [[nodiscard]] static Result<ChildProcess> Start(const std::vector<std::string>& argv,
                                                  const std::filesystem::path& log);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  // Returns how it ended, or nothing while it runs, without waiting.
  [[nodiscard]] std::optional<ExitStatus> Poll();
  // Asks it to end.
  void Terminate();
  // Waits for its end up to `bound`, then kills it with its whole group and waits for that.
  void Reap(std::chrono::milliseconds bound);

  [[nodiscard]] const std::filesystem::path& log() const { return log_; }

 private:
  ChildProcess(pid_t pid, std::filesystem::path log) : pid_(pid), log_(std::move(log)) {}

  pid_t pid_ = -1;  // -1 after a move
  std::optional<ExitStatus> status_;
  std::filesystem::path log_;
};

// Returns the last `count` lines of a text file, or none if there is no file.
[[nodiscard]] std::vector<std::string> LastLines(const std::filesystem::path& file,
                                                 std::size_t count);

}  // namespace trailcast::demo
