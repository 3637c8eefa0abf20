#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trailcast::network {

// What was changed of a route or of how routes are joined, when, by the clock of the server that
// has kept it, and by whom.
struct Change {
  std::int64_t at_unix_ms = 0;
  std::string by{};    // empty: not known
  std::string what{};  // in words: "activated hall@3", or an edit (words.h): "close hall 3..7"
  bool operator==(const Change&) const = default;
};

struct History {
  std::int64_t kept_since_unix_ms = 0;  // what was changed before it may be missing
  std::vector<Change> changes{};        // the oldest first
  bool operator==(const History&) const = default;
};

// The question for what was changed then or later: "changes since MILLISECONDS".
[[nodiscard]] std::string ChangesSince(std::int64_t unix_ms);
// Nothing for another question.
[[nodiscard]] std::optional<std::int64_t> ParseChangesSince(std::string_view words);

// A line of its answer: "changed MILLISECONDS BY WHAT"; before all of these "kept since
// MILLISECONDS".
[[nodiscard]] std::string ToText(const Change& change);
[[nodiscard]] std::string KeptSince(std::int64_t unix_ms);
// Lines that a later version may have are passed over.
[[nodiscard]] History ParseHistory(const std::vector<std::string>& lines);

// Of each of these, the oldest first, the routes that it is about: by the names that the last one
// has left them with, or by their ids where it says those.
[[nodiscard]] std::vector<std::vector<std::string>> RoutesOf(std::span<const Change> changes);

}  // namespace trailcast::network
