#include "services/program/live_lines.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace trailcast::program {
namespace {

// Lines are cut to the terminal's width, because a line that wraps would break the redrawing.
std::size_t TerminalWidth(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

}  // namespace

std::string ProgressBar(double fraction, int width) {
  const double share = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto done = static_cast<std::size_t>(std::lround(share * width));
  std::string bar(done, '=');
  bar.resize(static_cast<std::size_t>(width), ' ');
  if (done > 0 && done < bar.size()) bar[done - 1] = '>';
  return fmt::format("[{}]", bar);
}

LiveLines::LiveLines(std::FILE* out, std::chrono::milliseconds plain_interval)
    : out_(out), terminal_(isatty(fileno(out)) == 1), plain_interval_(plain_interval) {}

void LiveLines::Show(const std::vector<std::string>& lines, bool now) {
  std::string text;
  if (terminal_) {
    if (drawn_ > 0) text += fmt::format("\033[{}A", drawn_);
    const std::size_t width = TerminalWidth(fileno(out_));
    for (const std::string& line : lines)
      text += fmt::format("\r{}\033[K\n", line.substr(0, width - 1));
    drawn_ = lines.size();
  } else {
    const auto time = std::chrono::steady_clock::now();
    if (!now && time < next_plain_) return;
    next_plain_ = time + plain_interval_;
    for (const std::string& line : lines) text += fmt::format("{}\n", line);
  }
  std::fputs(text.c_str(), out_);
  std::fflush(out_);
}

}  // namespace trailcast::program
