#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/number.h"
#include "services/base/result.h"

namespace trailcast::trial {

// A change given by its name with a number: "jpeg=30".
template <typename Kind>
struct NamedChange {
  Kind kind;
  const char* name;
  double value;  // if none is given
  double least;
  double most;  // 0 if it takes no number
  const char* help;
  bool whole = false;  // the number must be whole
};

template <typename Change, typename Kind, std::size_t kCount>
[[nodiscard]] Result<Change> ParseNamedChange(std::string_view text,
                                              const std::array<NamedChange<Kind>, kCount>& known,
                                              const char* what) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const NamedChange<Kind>& each) { return each.name == name; });
  if (found == known.end()) {
    std::string names;
    for (const NamedChange<Kind>& each : known) {
      names += (names.empty() ? "" : ", ") + std::string(each.name);
    }
    return Fail(ErrorCode::kInvalidArgument, "there is no {} '{}'; there are: {}", what, name,
                names);
  }
  if (equals == std::string_view::npos) return Change{found->kind, found->value};
  const std::string_view value = text.substr(equals + 1);
  const auto number = ParseNumber<double>(value);
  const bool whole = number && (!found->whole || *number == std::floor(*number));
  if (!whole || !(*number >= found->least && *number <= found->most)) {
    return Fail(ErrorCode::kInvalidArgument, "the {} '{}' takes a {}number from {} to {}, not '{}'",
                what, name, found->whole ? "whole " : "", found->least, found->most, value);
  }
  return Change{found->kind, *number};
}

// Parses several of them, joined with '+'; "" or "none" stand for no change. Messages call one
// `what`.
template <typename Change, typename Kind, std::size_t kCount>
[[nodiscard]] Result<std::vector<Change>> ParseNamedChanges(
    std::string_view text, const std::array<NamedChange<Kind>, kCount>& known, const char* what) {
  std::vector<Change> changes;
  if (text.empty() || text == "none") return changes;
  while (true) {
    const std::size_t plus = text.find('+');
    const auto change = ParseNamedChange<Change>(text.substr(0, plus), known, what);
    if (!change) return tl::unexpected(change.error());
    changes.push_back(*change);
    if (plus == std::string_view::npos) return changes;
    text.remove_prefix(plus + 1);
  }
}

// Returns one line for each, for people.
template <typename Kind, std::size_t kCount>
[[nodiscard]] std::string HelpOf(const std::array<NamedChange<Kind>, kCount>& known) {
  std::string help;
  for (const NamedChange<Kind>& each : known) {
    const std::string usage =
        each.most > 0.0 ? fmt::format("{}={:g}", each.name, each.value) : std::string(each.name);
    help += fmt::format("  {:<11} {}\n", usage, each.help);
  }
  return help;
}

}  // namespace trailcast::trial
