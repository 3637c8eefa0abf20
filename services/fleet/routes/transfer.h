#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "services/program/live_lines.h"

namespace trailcast::fleet {

// This is how the transfer of a route to or from a server is watched.
struct TransferWatch {
  std::chrono::milliseconds timeout{10'000};  // without anything new
  std::function<bool()> stop = [] { return false; };
  std::function<void(std::uint64_t done_bytes)> progress = [](std::uint64_t) {};
};

// Returns "fetching 'hall': 40 % of 1.2 MB, about 12 s left". `elapsed` is how long `done` bytes
// took.
[[nodiscard]] std::string ProgressText(const std::string& doing, std::uint64_t done,
                                       std::uint64_t total, std::chrono::nanoseconds elapsed);

// This shows a line of progress for a transfer that takes more than a moment.
class TransferProgress {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kMoment{2};

  TransferProgress(std::string doing, std::uint64_t total_bytes);
  void Show(std::uint64_t done_bytes);

 private:
  std::string doing_;
  std::uint64_t total_bytes_;
  Clock::time_point began_ = Clock::now();
  program::LiveLines lines_;
};

}  // namespace trailcast::fleet
