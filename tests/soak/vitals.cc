#include "tests/soak/vitals.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace trailcast::soak {
namespace {

constexpr std::size_t kFewest = 8;

int EntriesOf(const std::filesystem::path& folder) {
  std::error_code gone;
  int entries = 0;
  for (auto at = std::filesystem::directory_iterator(folder, gone);
       !gone && at != std::filesystem::directory_iterator(); at.increment(gone)) {
    ++entries;
  }
  return entries;
}

Vitals Summary(std::span<const Vitals> samples) {
  std::vector<std::uint64_t> memory_kb;
  Vitals summary;
  for (const Vitals& sample : samples) {
    memory_kb.push_back(sample.memory_kb);
    summary.threads = std::max(summary.threads, sample.threads);
    summary.descriptors = std::max(summary.descriptors, sample.descriptors);
  }
  std::sort(memory_kb.begin(), memory_kb.end());
  summary.memory_kb = memory_kb[memory_kb.size() / 2];
  return summary;
}

}  // namespace

std::optional<Vitals> VitalsOf(pid_t pid) {
  const std::string folder = fmt::format("/proc/{}", pid);
  std::ifstream status(folder + "/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("VmRSS:")) continue;
    Vitals vitals{.threads = EntriesOf(folder + "/task"), .descriptors = EntriesOf(folder + "/fd")};
    std::istringstream(line.substr(6)) >> vitals.memory_kb;
    return vitals;
  }
  return std::nullopt;
}

double Growth::memory_share() const {
  return static_cast<double>(last.memory_kb) / static_cast<double>(first.memory_kb) - 1.0;
}

std::optional<Growth> GrowthOf(std::span<const Vitals> samples) {
  if (samples.size() < kFewest) return std::nullopt;
  const std::size_t quarter = samples.size() / 4;
  return Growth{Summary(samples.first(quarter)), Summary(samples.last(quarter))};
}

bool IsFlat(const Growth& growth) {
  constexpr double kMostShare = 0.05;
  return growth.memory_share() <= kMostShare && growth.last.threads <= growth.first.threads &&
         growth.last.descriptors <= growth.first.descriptors;
}

}  // namespace trailcast::soak
