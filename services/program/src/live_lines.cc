#include "services/program/live_lines.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace trailcast::program {
namespace {

struct Terminal {
  std::size_t width = 80;
  std::size_t height = 24;
};

Terminal TerminalOf(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return {size.ws_col, std::max<std::size_t>(size.ws_row, 2)};
}

// Returns the lines that fit on the terminal, because a line that wraps or scrolls away would break
// the redrawing. The cursor has the last one.
std::vector<std::string> Fitting(std::vector<std::string> lines, const Terminal& terminal) {
  if (lines.size() > terminal.height - 1) {
    const std::size_t left_out = lines.size() - (terminal.height - 2);
    lines.resize(terminal.height - 2);
    lines.push_back(fmt::format("... {} more lines: the window is too low for them", left_out));
  }
  for (std::string& line : lines) line.resize(std::min(line.size(), terminal.width - 1));
  return lines;
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
    const auto fitting = Fitting(lines, TerminalOf(fileno(out_)));
    for (const std::string& line : fitting) text += fmt::format("\r{}\033[K\n", line);
    text += "\033[J";  // what was drawn below
    drawn_ = fitting.size();
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
