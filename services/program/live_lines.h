#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace trailcast::program {

// Returns "[=======>      ]" for a fraction of 0..1.
[[nodiscard]] std::string ProgressBar(double fraction, int width);

// A block of lines that shows the present state. It is redrawn in place on a terminal, and printed
// again now and then elsewhere (a log file, a pipe).
class LiveLines {
 public:
  // `out` stays the caller's.
  explicit LiveLines(std::FILE* out,
                     std::chrono::milliseconds plain_interval = std::chrono::seconds(5));

  // Shows the lines. Without a terminal it does so only if the plain interval has passed, or `now`
  // is set.
  void Show(const std::vector<std::string>& lines, bool now = false);

 private:
  std::FILE* out_;
  bool terminal_;
  std::chrono::milliseconds plain_interval_;
  std::chrono::steady_clock::time_point next_plain_{};
  std::size_t drawn_ = 0;  // lines on the terminal that the next Show will overwrite
};

}  // namespace trailcast::program
