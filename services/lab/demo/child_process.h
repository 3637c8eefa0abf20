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

// A process of ours: ended when this object goes, and by the kernel when our own process dies in
// whatever way. Has a process group of its own, so that Ctrl-C reaches us alone and we end it in
// order. Start from the main thread: the kernel watches the thread that started it.
class ChildProcess {
 public:
  // argv[0] is the program's path. stdout and stderr go to `log`, stdin is empty.
  [[nodiscard]] static Result<ChildProcess> Start(const std::vector<std::string>& argv,
                                                  const std::filesystem::path& log);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  // How it ended, or nothing while it runs. Does not wait.
  [[nodiscard]] std::optional<ExitStatus> Poll();
  // Asks it to end.
  void Terminate();
  // Waits for its end up to `bound`, then kills it with its whole group and waits for that.
  void Reap(std::chrono::milliseconds bound);

  [[nodiscard]] const std::filesystem::path& log() const { return log_; }

 private:
  ChildProcess(pid_t pid, std::filesystem::path log) : pid_(pid), log_(std::move(log)) {}

  pid_t pid_ = -1;  // -1: moved from
  std::optional<ExitStatus> status_;
  std::filesystem::path log_;
};

// The last `count` lines of a text file; empty if there is none.
[[nodiscard]] std::vector<std::string> LastLines(const std::filesystem::path& file,
                                                 std::size_t count);

}  // namespace trailcast::demo
