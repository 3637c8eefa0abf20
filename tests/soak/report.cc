#include "tests/soak/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace trailcast::soak {
namespace {

std::string FaultLines(const std::vector<Faults::Recovery>& recoveries) {
  std::map<std::string, std::vector<double>> by_kind;
  for (const auto& [from, seconds] : recoveries) by_kind[from].push_back(seconds);
  std::string text = fmt::format("  {:<40} {:>5} {:>12} {:>12}\n", "faults, until all were heard",
                                 "times", "median, s", "longest, s");
  for (auto& [kind, seconds] : by_kind) {
    std::sort(seconds.begin(), seconds.end());
    text += fmt::format("  {:<40} {:>5} {:>12.1f} {:>12.1f}\n", kind, seconds.size(),
                        seconds[seconds.size() / 2], seconds.back());
  }
  return text;
}

std::string VitalsLine(const std::vector<Vitals>& samples) {
  const auto growth = GrowthOf(samples);
  if (!growth) {
    return fmt::format("  server: {} seconds are too few to judge its memory\n", samples.size());
  }
  constexpr double kKbPerMb = 1000.0;
  return fmt::format(
      "  server, one process over {} seconds after its warm-up: {:.1f} -> {:.1f} MB ({:+.1f} %), "
      "threads {} -> {}, descriptors {} -> {}\n",
      samples.size(), static_cast<double>(growth->first.memory_kb) / kKbPerMb,
      static_cast<double>(growth->last.memory_kb) / kKbPerMb, 100.0 * growth->memory_share(),
      growth->first.threads, growth->last.threads, growth->first.descriptors,
      growth->last.descriptors);
}

}  // namespace

void Report::Add(const Cycle::Outcome& outcome) {
  ++cycles;
  segments += outcome.segments;
  arrived += outcome.arrived;
  explained.insert(explained.end(), outcome.explained.begin(), outcome.explained.end());
  failures.insert(failures.end(), outcome.failures.begin(), outcome.failures.end());
}

std::string Report::Text() const {
  std::string text = fmt::format(
      "soak of {:.1f} minutes, seed {}\n"
      "  {} cycles: {} segments taught, {} followers arrived, {} said why they did not; beside "
      "them {} "
      "robots killed, stopped or cut off while they fetched, and left so\n"
      "  {} segments receipted; {} looked at in {} checks of the server's store\n",
      took.count() / 60.0, seed, cycles, segments, arrived, explained.size(), casualties, receipted,
      checked, store_checks);
  for (const std::string& why : explained) text += "    " + why + "\n";
  text += FaultLines(recoveries) + VitalsLine(server);
  for (const std::string& failure : failures) text += "FAILED: " + failure + "\n";
  return text + (failures.empty() ? "passed\n" : fmt::format("{} failures\n", failures.size()));
}

}  // namespace trailcast::soak
