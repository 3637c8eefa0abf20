#include "services/network/changes.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/base/number.h"

namespace trailcast::network {
namespace {

constexpr std::string_view kQuestion = "changes since ";
constexpr std::string_view kChanged = "changed ";
constexpr std::string_view kKept = "kept since ";
constexpr std::string_view kUnknown = "-";

// What is behind `before` as a number; nothing for another line.
std::optional<std::int64_t> NumberBehind(std::string_view before, std::string_view line) {
  if (!line.starts_with(before)) return std::nullopt;
  return ParseNumber<std::int64_t>(line.substr(before.size()));
}

// Up to the next blank, which goes with it.
std::string_view TakeWord(std::string_view& rest) {
  const std::string_view word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(std::min(word.size() + 1, rest.size()));
  return word;
}

std::optional<Change> ParseChange(std::string_view line) {
  if (!line.starts_with(kChanged)) return std::nullopt;
  line.remove_prefix(kChanged.size());
  const auto at_unix_ms = ParseNumber<std::int64_t>(TakeWord(line));
  const std::string_view by = TakeWord(line);
  if (!at_unix_ms || by.empty() || line.empty()) return std::nullopt;
  return Change{*at_unix_ms, by == kUnknown ? "" : std::string(by), std::string(line)};
}

}  // namespace

std::string ChangesSince(std::int64_t unix_ms) { return fmt::format("{}{}", kQuestion, unix_ms); }

std::optional<std::int64_t> ParseChangesSince(std::string_view words) {
  return NumberBehind(kQuestion, words);
}

std::string ToText(const Change& change) {
  return fmt::format("{}{} {} {}", kChanged, change.at_unix_ms,
                     change.by.empty() ? kUnknown : change.by, change.what);
}

std::string KeptSince(std::int64_t unix_ms) { return fmt::format("{}{}", kKept, unix_ms); }

History ParseHistory(const std::vector<std::string>& lines) {
  History history;
  for (const std::string& line : lines) {
    if (const auto kept_since = NumberBehind(kKept, line)) {
      history.kept_since_unix_ms = *kept_since;
    } else if (auto change = ParseChange(line)) {
      history.changes.push_back(*std::move(change));
    }
  }
  return history;
}

}  // namespace trailcast::network
