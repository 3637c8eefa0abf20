#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/network_lab.h"
#include "tests/support/process.h"

namespace trailcast::soak {

using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

// This gives the programs clocks that can be stepped (package libfaketime).
inline constexpr const char* kClockLibrary =
    "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";

// This is one program at a host of its own, which can be started, killed and started again.
class Member {
 public:
  // `name` is the program's name in the fleet, too. Logs go to `folder`, one for each start.
  Member(test::NetworkLab& lab, int host, std::string name, std::filesystem::path folder);

  // `program` is one of this project's.
  void Start(const std::string& program, const Words& words);
  void Kill();
  // Ends waiting for it.
  void Forget() { process_.reset(); }

  // Returns whether it was started, and was neither killed nor ended by itself.
  [[nodiscard]] bool running();
  // Returns the exit status of a program that ended by itself, once.
  [[nodiscard]] std::optional<int> TakeEnded();
  // Ends the program and returns its status, or nothing if it does not end within the bound.
  [[nodiscard]] std::optional<int> Stop();
  // Removes the host's address; another one comes later.
  void LoseAddress();
  void TakeOtherAddress();
  // Steps the wall clock of the host's programs, but not the clock by which they wait.
  void SetClockAhead(std::chrono::seconds by) const;
  void Signal(int signal) const { process_->Signal(signal); }
  [[nodiscard]] pid_t pid() const { return process_->pid(); }

  // Notes that its status was received.
  void NoteHeard(Clock::time_point at) { heard_at_ = at; }
  [[nodiscard]] Clock::time_point heard_at() const { return heard_at_; }

  [[nodiscard]] int host() const { return host_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  // Returns the log's last lines.
  [[nodiscard]] std::string LastWords() const;

 private:
  [[nodiscard]] std::filesystem::path ClockFile() const;

  test::NetworkLab& lab_;
  int host_;
  int address_;
  std::string name_;
  std::filesystem::path folder_;
  int starts_ = 0;
  std::unique_ptr<test::Process> process_;
  Clock::time_point heard_at_{};
};

}  // namespace trailcast::soak
