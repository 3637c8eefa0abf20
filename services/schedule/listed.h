#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/schedule/schedule.h"

namespace trailcast::schedule {

// This is a schedule as a server has it.
struct Listed {
  // This tells what became of the last time that it was due, for one robot.
  struct Sent {
    std::string robot{};
    std::string mission{};  // its name; empty if none was ever sent
    std::string outcome{};  // for people: why it was not sent, or what became of the mission
    bool operator==(const Sent&) const = default;
  };
  Schedule schedule{};
  std::string by{};         // who made it
  std::string paused_by{};  // empty if it is not paused
  std::optional<std::int64_t> next_unix_ms{};
  std::optional<std::int64_t> last_unix_ms{};  // when it was due last
  std::string outcome{};                       // why nobody was sent then; empty if somebody was
  std::vector<Sent> sent{};
  bool operator==(const Listed&) const = default;
};

// This question asks a server for all schedules, in the words of exchange::NetworkRequest.
inline constexpr std::string_view kQuestion = "schedules";

// Each schedule is listed in several lines:
//   schedule WORDS
//   due NAME BY NEXT LAST [paused BY]    milliseconds since 1970, or '-'
//   outcome NAME WORDS
//   sent NAME ROBOT MISSION|- WORDS
[[nodiscard]] std::vector<std::string> LinesOf(const Listed& listed);
// Leaves out lines that are not understood, which a newer server may have.
[[nodiscard]] std::vector<Listed> ParseLines(const std::vector<std::string>& lines);

// An operator's change, in the words of exchange::NetworkEdit. It is for one server, because each
// keeps its own schedules, and others leave it alone:
//   schedule SERVER add WORDS | change WORDS | remove NAME | pause NAME | resume NAME
struct Edit {
  enum class Kind { kAdd, kChange, kRemove, kPause, kResume };
  std::string server{};
  Kind kind = Kind::kAdd;
  Schedule schedule{};  // only its name, unless it is added or changed
};
[[nodiscard]] std::string ToText(const Edit& edit);
[[nodiscard]] bool IsEdit(std::string_view words);
// Returns the server that an edit is for, or an empty text.
[[nodiscard]] std::string ServerOf(std::string_view words);
[[nodiscard]] Result<Edit> ParseScheduleEdit(std::string_view words);

}  // namespace trailcast::schedule
