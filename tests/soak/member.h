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

// Gives the programs clocks that can be stepped (package libfaketime).
inline constexpr const char* kClockLibrary =
    "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1";

// One program at a host of its own: started, killed and started again.
class Member {
 public:
  // `name` is the program's name in the fleet, too. Logs go to `folder`, one for each start.
  Member(test::NetworkLab& lab, int host, std::string name, std::filesystem::path folder);

  // `program` is one of ours.
  void Start(const std::string& program, const Words& words);
  void Kill();
  // Nobody waits for it any more.
  void Forget() { process_.reset(); }

  // Started, not killed, not ended by itself.
  [[nodiscard]] bool running();
  // The exit status, once, of a program that ended by itself.
  [[nodiscard]] std::optional<int> TakeEnded();
  // Ended as asked, with what status; nothing if not within the bound.
  [[nodiscard]] std::optional<int> Stop();
  // Takes the host's address away; another one comes later.
  void LoseAddress();
  void TakeOtherAddress();
  // Steps the wall clock of the host's programs, not the time by which they wait.
  void SetClockAhead(std::chrono::seconds by) const;
  void Signal(int signal) const { process_->Signal(signal); }
  [[nodiscard]] pid_t pid() const { return process_->pid(); }

  // Its status was received.
  void NoteHeard(Clock::time_point at) { heard_at_ = at; }
  [[nodiscard]] Clock::time_point heard_at() const { return heard_at_; }

  [[nodiscard]] int host() const { return host_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  // The log's last lines.
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
