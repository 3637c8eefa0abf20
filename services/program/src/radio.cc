#include "services/program/radio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <vector>

#include "services/base/number.h"

namespace trailcast::program {
namespace {

// In Linux (net/wireless/wext-compat.c), if the level is in dBm, from -110 to -40, the quality is
// its distance from -110; otherwise it is a percentage.
constexpr double kBestOfDbm = 70.0;
constexpr double kBestOfPercent = 100.0;
constexpr std::size_t kMostBytes = 4096;

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

// "60." is a value that was renewed lately; "60" is one that was not.
std::optional<double> Value(std::string_view word) {
  if (word.ends_with('.')) word.remove_suffix(1);
  const auto value = ParseNumber<double>(word);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return *value;
}

// A name is followed by status, quality of the link, level, noise, ..
std::optional<std::uint8_t> PercentOf(std::string_view line) {
  const auto words = Words(line);
  if (words.size() < 3) return std::nullopt;
  const auto quality = Value(words[1]);
  const auto level = Value(words[2]);
  if (!quality || !level) return std::nullopt;
  const double best = *level < 0.0 ? kBestOfDbm : kBestOfPercent;
  return static_cast<std::uint8_t>(std::lround(100.0 * std::clamp(*quality / best, 0.0, 1.0)));
}

}  // namespace

std::optional<std::uint8_t> LinkPercent(std::string_view text, std::string_view interface) {
  std::optional<std::string_view> found;
  int radios = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) continue;  // the columns' headings
    const auto name = Words(line.substr(0, colon));
    if (name.size() != 1) continue;
    ++radios;
    if (interface.empty() || name.front() == interface) found = line.substr(colon + 1);
  }
  if (!found || (interface.empty() && radios > 1)) return std::nullopt;
  return PercentOf(*found);
}

std::optional<std::uint8_t> LinkPercent(const std::string& interface) {
  std::ifstream file("/proc/net/wireless");
  std::array<char, kMostBytes> text{};
  file.read(text.data(), text.size());
  return LinkPercent({text.data(), static_cast<std::size_t>(file.gcount())}, interface);
}

}  // namespace trailcast::program
