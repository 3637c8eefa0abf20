#include "agent/teach/unfinished.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <map>
#include <optional>

#include "services/base/unix_time.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

const std::map<std::string, Unfinished> kNames = {{"ask", Unfinished::kAsk},
                                                  {"keep", Unfinished::kKeep},
                                                  {"go-on", Unfinished::kGoOn},
                                                  {"discard", Unfinished::kDiscard}};

constexpr const char* kQuestion =
    "  g  go on with it: drive the robot over the last metres of it once more, and on from there\n"
    "  k  keep it as it is, and teach the route anew; robots follow it only if an operator "
    "activates it\n"
    "  d  discard it, and teach the route anew\n"
    "Go on, keep or discard? [g, K, d] ";

// Returns a line from standard input, or nothing if there will be none.
std::optional<std::string> ReadAnswer(const std::function<bool()>& stop) {
  constexpr int kLookEvery_ms = 200;
  constexpr std::size_t kLongest = 100;
  std::string line;
  while (!stop()) {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    if (poll(&in, 1, kLookEvery_ms) <= 0) continue;
    char letter = 0;
    if (read(STDIN_FILENO, &letter, 1) != 1) return std::nullopt;
    if (letter == '\n') return line;
    if (line.size() < kLongest) line += letter;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> UnfinishedNames() {
  std::vector<std::string> names;
  for (const auto& [name, unfinished] : kNames) names.push_back(name);
  return names;
}

Unfinished UnfinishedOf(const std::string& name) { return kNames.at(name); }

std::string DescribeUnfinished(const route::RouteInfo& cut_off) {
  return fmt::format("an earlier teaching of route '{}' was cut off: {}, {} segments, {:.1f} m, {}",
                     cut_off.name, route::ShortIds().Of(cut_off), cut_off.segment_count,
                     cut_off.length_m, DateText(cut_off.taught_unix_ms));
}

Unfinished AskOnTerminal(const route::RouteInfo& cut_off, const std::function<bool()>& stop) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return Unfinished::kKeep;
  while (true) {
    fmt::print(stderr, "{}\n{}", DescribeUnfinished(cut_off), kQuestion);
    std::fflush(stderr);
    const auto answer = ReadAnswer(stop);
    if (!answer || answer->empty() || answer == "k" || answer == "K") return Unfinished::kKeep;
    if (answer == "g") return Unfinished::kGoOn;
    if (answer == "d") return Unfinished::kDiscard;
  }
}

}  // namespace trailcast::agent
