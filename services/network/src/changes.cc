#include "services/network/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "services/base/number.h"
#include "services/network/words.h"

namespace trailcast::network {
namespace {

constexpr std::string_view kQuestion = "changes since ";
constexpr std::string_view kChanged = "changed ";
constexpr std::string_view kKept = "kept since ";
constexpr std::string_view kUnknown = "-";

// Returns the number behind `before`, or nothing for another line.
std::optional<std::int64_t> NumberBehind(std::string_view before, std::string_view line) {
  if (!line.starts_with(before)) return std::nullopt;
  return ParseNumber<std::int64_t>(line.substr(before.size()));
}

// Takes the word up to the next blank, and removes the blank too.
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

// These stand before a changed revision, "hall@3".
constexpr std::array<std::string_view, 7> kOfRevisions = {
    "stored", "activated", "retired", "deleted", "tagged", "untagged", "described"};

// Parses "renamed hall to aisle".
std::optional<std::pair<std::string, std::string>> ParseRenaming(std::string_view what) {
  if (TakeWord(what) != "renamed") return std::nullopt;
  std::string before(TakeWord(what));
  if (TakeWord(what) != "to") return std::nullopt;
  return std::pair(std::move(before), std::string(TakeWord(what)));
}

std::vector<std::string> RoutesIn(const Edit& edit) {
  std::vector<std::string> routes{edit.junction.from.route, edit.junction.to.route,
                                  edit.condition.route, edit.named.place.route};
  for (const Part& part : edit.lane.parts) routes.push_back(part.route);
  return routes;
}

// Returns the routes with their revisions, as the text has them.
std::vector<std::string> RoutesIn(std::string_view what) {
  if (const auto edit = ParseEdit(what)) return RoutesIn(*edit);
  if (const auto renaming = ParseRenaming(what)) return {renaming->second};
  const std::string_view verb = TakeWord(what);
  if (std::find(kOfRevisions.begin(), kOfRevisions.end(), verb) == kOfRevisions.end()) return {};
  return {std::string(TakeWord(what))};
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

std::vector<std::vector<std::string>> RoutesOf(std::span<const Change> changes) {
  std::vector<std::vector<std::string>> routes(changes.size());
  std::map<std::string, std::string> now_called;
  for (std::size_t i = changes.size(); i-- > 0;) {
    for (const std::string& word : RoutesIn(changes[i].what)) {
      std::string name = word.substr(0, word.find_first_of("@,:"));
      if (const auto now = now_called.find(name); now != now_called.end()) name = now->second;
      const bool is_told = std::find(routes[i].begin(), routes[i].end(), name) != routes[i].end();
      if (!name.empty() && !is_told) routes[i].push_back(std::move(name));
    }
    const auto renaming = ParseRenaming(changes[i].what);
    if (renaming && !routes[i].empty()) now_called[renaming->first] = routes[i].front();
  }
  return routes;
}

}  // namespace trailcast::network
