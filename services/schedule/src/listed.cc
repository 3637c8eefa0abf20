#include "services/schedule/listed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/base/ids.h"
#include "services/base/number.h"

namespace trailcast::schedule {
namespace {

constexpr std::string_view kEdit = "schedule ";
constexpr std::array<std::string_view, 5> kKinds{"add", "change", "remove", "pause", "resume"};

bool HasWords(Edit::Kind kind) { return kind == Edit::Kind::kAdd || kind == Edit::Kind::kChange; }

// Takes the first word off a text.
std::string TakeWord(std::string_view& text) {
  const std::size_t end = std::min(text.find(' '), text.size());
  std::string word(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

std::string MomentWord(const std::optional<std::int64_t>& unix_ms) {
  return unix_ms ? fmt::format("{}", *unix_ms) : "-";
}

std::optional<std::int64_t> ReadMoment(const std::string& word) {
  return ParseNumber<std::int64_t>(word);
}

std::string WordOrDash(const std::string& word) { return word.empty() ? "-" : word; }
std::string WordUnlessDash(std::string word) { return word == "-" ? "" : std::move(word); }

}  // namespace

std::vector<std::string> LinesOf(const Listed& listed) {
  const std::string& name = listed.schedule.name;
  std::vector<std::string> lines{fmt::format("{}{}", kEdit, ToText(listed.schedule))};
  std::string due = fmt::format("due {} {} {} {}", name, WordOrDash(listed.by),
                                MomentWord(listed.next_unix_ms), MomentWord(listed.last_unix_ms));
  if (!listed.paused_by.empty()) due += " paused " + listed.paused_by;
  lines.push_back(std::move(due));
  if (!listed.outcome.empty()) {
    lines.push_back(fmt::format("outcome {} {}", name, listed.outcome));
  }
  for (const Listed::Sent& sent : listed.sent) {
    lines.push_back(
        fmt::format("sent {} {} {} {}", name, sent.robot, WordOrDash(sent.mission), sent.outcome));
  }
  return lines;
}

std::vector<Listed> ParseLines(const std::vector<std::string>& lines) {
  std::vector<Listed> all;
  for (const std::string& line : lines) {
    std::string_view rest = line;
    const std::string what = TakeWord(rest);
    if (what == "schedule") {
      if (auto schedule = ParseSchedule(rest)) {
        all.emplace_back().schedule = *std::move(schedule);
      }
      continue;
    }
    const std::string name = TakeWord(rest);
    if (all.empty() || all.back().schedule.name != name) continue;
    Listed& listed = all.back();
    if (what == "due") {
      listed.by = WordUnlessDash(TakeWord(rest));
      listed.next_unix_ms = ReadMoment(TakeWord(rest));
      listed.last_unix_ms = ReadMoment(TakeWord(rest));
      if (TakeWord(rest) == "paused") listed.paused_by = TakeWord(rest);
    } else if (what == "outcome") {
      listed.outcome = rest;
    } else if (what == "sent") {
      Listed::Sent& sent = listed.sent.emplace_back();
      sent.robot = TakeWord(rest);
      sent.mission = WordUnlessDash(TakeWord(rest));
      sent.outcome = rest;
    }
  }
  return all;
}

std::string ToText(const Edit& edit) {
  return fmt::format("{}{} {} {}", kEdit, edit.server, kKinds[static_cast<std::size_t>(edit.kind)],
                     HasWords(edit.kind) ? ToText(edit.schedule) : edit.schedule.name);
}

bool IsEdit(std::string_view words) { return words.starts_with(kEdit); }

std::string ServerOf(std::string_view words) {
  if (!IsEdit(words)) return {};
  words.remove_prefix(kEdit.size());
  return TakeWord(words);
}

Result<Edit> ParseScheduleEdit(std::string_view words) {
  Edit edit{.server = ServerOf(words)};
  words.remove_prefix(std::min(kEdit.size() + edit.server.size() + 1, words.size()));
  const std::string kind = TakeWord(words);
  const auto* known = std::find(kKinds.begin(), kKinds.end(), kind);
  if (known == kKinds.end()) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}': expected 'schedule SERVER' and then 'add', 'change', 'remove', 'pause' or "
                "'resume'",
                kind);
  }
  edit.kind = static_cast<Edit::Kind>(known - kKinds.begin());
  if (HasWords(edit.kind)) {
    auto schedule = ParseSchedule(words);
    if (!schedule) return tl::unexpected(schedule.error());
    edit.schedule = *std::move(schedule);
    return edit;
  }
  edit.schedule.name = words;
  if (IsValidName(edit.schedule.name)) return edit;
  return Fail(ErrorCode::kInvalidArgument, "'{}' is no name of a schedule", edit.schedule.name);
}

}  // namespace trailcast::schedule
