#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace trailcast::network {

// This is a change of a route or of how routes are joined: who made it, and when by the clock of
// the server that recorded it.
struct Change {
  std::int64_t at_unix_ms = 0;
  std::string by{};    // empty if not known
  std::string what{};  // in words: "activated hall@3", or an edit (words.h): "close hall 3..7"
  bool operator==(const Change&) const = default;
};

struct History {
  std::int64_t kept_since_unix_ms = 0;  // changes before this may be missing
  std::vector<Change> changes{};        // the oldest first
  bool operator==(const History&) const = default;
};

// Returns the question for changes at that time or later: "changes since MILLISECONDS".
[[nodiscard]] std::string ChangesSince(std::int64_t unix_ms);
// Returns nothing for another question.
[[nodiscard]] std::optional<std::int64_t> ParseChangesSince(std::string_view words);

// Returns a line of the answer: "changed MILLISECONDS BY WHAT". "kept since MILLISECONDS" comes
// before all of these.
[[nodiscard]] std::string ToText(const Change& change);
[[nodiscard]] std::string KeptSince(std::int64_t unix_ms);
// Ignores lines that a later version may have.
[[nodiscard]] History ParseHistory(const std::vector<std::string>& lines);

// Returns for each change, the oldest first, the routes that it is about, by the names that the
// last change has left them with, or by their ids where the change has those.
[[nodiscard]] std::vector<std::vector<std::string>> RoutesOf(std::span<const Change> changes);

}  // namespace trailcast::network
