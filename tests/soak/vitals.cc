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

template <typename Number>
Number Median(std::span<const Vitals> samples, Number Vitals::*field) {
  std::vector<Number> values;
  for (const Vitals& sample : samples) values.push_back(sample.*field);
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Vitals Medians(std::span<const Vitals> samples) {
  return {Median(samples, &Vitals::memory_kb), Median(samples, &Vitals::threads),
          Median(samples, &Vitals::descriptors)};
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
  return Growth{Medians(samples.first(quarter)), Medians(samples.last(quarter))};
}

bool IsFlat(const Growth& growth) {
  constexpr double kMostShare = 0.05;
  return growth.memory_share() <= kMostShare && growth.last.threads <= growth.first.threads &&
         growth.last.descriptors <= growth.first.descriptors;
}

}  // namespace trailcast::soak
