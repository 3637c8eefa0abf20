#include "agent/diagnosis/run_log_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <variant>

#include "services/base/number.h"

namespace trailcast::agent {
namespace {

using Member = std::variant<int FrameRow::*, double FrameRow::*, std::optional<double> FrameRow::*,
                            Phase FrameRow::*>;

struct Column {
  const char* name;
  Member member;
  int decimals = 0;
  bool later = false;  // added since the first logs of this version, which do without
};

// All that is known of the columns: writer and reader are made of this table.
const std::array kColumns = {
    Column{"frame", &FrameRow::frame},
    Column{"t_s", &FrameRow::t_s, 3},
    Column{"segment", &FrameRow::segment},
    Column{"fraction", &FrameRow::fraction, 3},
    Column{"progress", &FrameRow::progress, 4},
    Column{"phase", &FrameRow::phase},
    Column{"stored", &FrameRow::stored},
    Column{"tracked", &FrameRow::tracked},
    Column{"agreeing", &FrameRow::agreeing},
    Column{"rejected", &FrameRow::rejected},
    Column{"rejected_by_px", &FrameRow::rejected_by_px, 0},
    Column{"left_picture", &FrameRow::left_picture},
    Column{"not_returned", &FrameRow::not_returned},
    Column{"turn_rad", &FrameRow::turn_rad, 3},
    Column{"vision_turn_rad", &FrameRow::vision_turn_rad, 3},
    Column{"odometry_turn_rad", &FrameRow::odometry_turn_rad, 3},
    Column{"delta", &FrameRow::delta, 3},
    Column{"delta_minus", &FrameRow::delta_minus, 3},
    Column{"left_m", &FrameRow::left_m, 3},
    Column{"left_sigma_m", &FrameRow::left_sigma_m, 3},
    Column{"heading_rad", &FrameRow::heading_rad, 3},
    Column{"along_m", &FrameRow::along_m, 3},
    Column{"mount_yaw_rad", &FrameRow::mount_yaw_rad, 3},
    Column{"magnification", &FrameRow::magnification, 3},
    Column{"driven_m", &FrameRow::driven_m, 3},
    Column{"x_m", &FrameRow::x_m, 3},
    Column{"y_m", &FrameRow::y_m, 3},
    Column{"linear_mps", &FrameRow::linear_mps, 3},
    Column{"angular_radps", &FrameRow::angular_radps, 3},
    Column{"cpu_ms", &FrameRow::cpu_ms, 2},
    Column{"true_off_m", &FrameRow::true_off_m, 3},
    Column{"place", &FrameRow::place, 4, true},
    Column{"place_sigma", &FrameRow::place_sigma, 4, true},
    Column{"off_route", &FrameRow::off_route, 3, true},
};

constexpr std::string_view kTitle = "# trailcast replay log ";

std::string Fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  return fmt::format("{:.{}f}", value, decimals);
}

std::string CellText(const FrameRow& row, const Column& column) {
  if (const auto* member = std::get_if<int FrameRow::*>(&column.member)) {
    return std::to_string(row.**member);
  }
  if (const auto* member = std::get_if<Phase FrameRow::*>(&column.member)) {
    return ToString(row.**member);
  }
  if (const auto* member = std::get_if<double FrameRow::*>(&column.member)) {
    return Fixed(row.**member, column.decimals);
  }
  const auto& value = row.*std::get<std::optional<double> FrameRow::*>(column.member);
  return value ? Fixed(*value, column.decimals) : "-";
}

bool ParseReal(std::string_view word, double& number) {
  return ReadNumber(word, number) && std::isfinite(number);
}

bool ParseCell(std::string_view word, const Column& column, FrameRow& row) {
  if (const auto* member = std::get_if<int FrameRow::*>(&column.member)) {
    return ReadNumber(word, row.**member);
  }
  if (const auto* member = std::get_if<Phase FrameRow::*>(&column.member)) {
    const auto phase = ParsePhase(std::string(word));
    if (phase) row.** member = *phase;
    return phase.has_value();
  }
  if (const auto* member = std::get_if<double FrameRow::*>(&column.member)) {
    return word == "-" || ParseReal(word, row.**member);
  }
  if (word == "-") return true;
  auto& value = row.*std::get<std::optional<double> FrameRow::*>(column.member);
  return ParseReal(word, value.emplace());
}

// Line ends and other control characters would break the format.
std::string OneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return text.substr(0, kLongestLogLine / 2);
}

std::string OneWord(std::string text) {
  text = OneLine(std::move(text));
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

}  // namespace

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(' '); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(' ', end);
  }
  return words;
}

std::string FirstLine() { return fmt::format("{}{}\n", kTitle, kRunLogVersion); }

std::string HeaderText(const Fields& header) {
  std::string text;
  for (const auto& [key, value] : header.all()) {
    text += fmt::format("# {} {}\n", OneWord(key), OneLine(value));
  }
  text += "# columns";
  for (const Column& column : kColumns) text += fmt::format(" {}", column.name);
  return text + "\n";
}

std::string RowText(const FrameRow& row) {
  std::string text;
  for (const Column& column : kColumns) {
    if (!text.empty()) text += ' ';
    text += CellText(row, column);
  }
  return text + "\n";
}

std::string EventText(const RunEvent& event) {
  return fmt::format("! {} {:.3f} {}\n", event.frame, event.t_s, DescribeEvent(event));
}

std::string DescribeEvent(const RunEvent& event) {
  std::string text = OneWord(event.what);
  for (const auto& [key, value] : event.fields.all()) {
    text += fmt::format(" {}={}", OneWord(key), OneWord(value));
  }
  if (!event.text.empty()) text += " : " + OneLine(event.text);
  return text;
}

std::vector<Cell> CellsOf(const FrameRow& row) {
  std::vector<Cell> cells;
  for (const Column& column : kColumns) {
    Cell& cell = cells.emplace_back();
    if (const auto* count = std::get_if<int FrameRow::*>(&column.member)) {
      cell = row.**count;
    } else if (const auto* phase = std::get_if<Phase FrameRow::*>(&column.member)) {
      cell = static_cast<int>(row.**phase);
    } else if (const auto* number = std::get_if<double FrameRow::*>(&column.member)) {
      cell = row.**number;
    } else {
      const auto& value = row.*std::get<std::optional<double> FrameRow::*>(column.member);
      if (value) cell = *value;
    }
  }
  return cells;
}

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const Column& column : kColumns) names.emplace_back(column.name);
  return names;
}

Result<void> CheckFirstLine(std::string_view line) {
  if (line.substr(0, kTitle.size()) != kTitle) {
    return Fail(ErrorCode::kCorrupt, "not a replay's log: its first line is not '{}{}'", kTitle,
                kRunLogVersion);
  }
  const std::string_view version = line.substr(kTitle.size());
  if (version != std::to_string(kRunLogVersion)) {
    return Fail(ErrorCode::kCorrupt, "a replay's log of version '{}'; this program reads {}",
                version.substr(0, 20), kRunLogVersion);
  }
  return {};
}

Result<std::vector<std::string>> ParseColumns(std::string_view names) {
  std::vector<std::string> columns;
  for (const std::string_view name : Words(names)) columns.emplace_back(name);
  for (const Column& column : kColumns) {
    if (!column.later && std::find(columns.begin(), columns.end(), column.name) == columns.end()) {
      return Fail(ErrorCode::kCorrupt, "the header lists no column '{}'", column.name);
    }
  }
  return columns;
}

Result<FrameRow> ParseRow(std::string_view line, const std::vector<std::string>& columns) {
  const auto words = Words(line);
  if (words.size() != columns.size()) {
    return Fail(ErrorCode::kCorrupt, "{} values where the header lists {} columns", words.size(),
                columns.size());
  }
  FrameRow row;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto* column = std::find_if(kColumns.begin(), kColumns.end(),
                                      [&](const Column& each) { return columns[i] == each.name; });
    if (column != kColumns.end() && !ParseCell(words[i], *column, row)) {
      return Fail(ErrorCode::kCorrupt, "'{}' is no {}", words[i].substr(0, 30), columns[i]);
    }
  }
  return row;
}

Result<RunEvent> ParseEvent(std::string_view line) {
  RunEvent event;
  const std::size_t colon = line.find(" : ");
  if (colon != std::string_view::npos) event.text = line.substr(colon + 3);
  const auto words = Words(line.substr(0, colon));
  if (words.size() < 4 || words[0] != "!" || !ReadNumber(words[1], event.frame) ||
      !ParseReal(words[2], event.t_s)) {
    return Fail(ErrorCode::kCorrupt, "an event is '! FRAME SECONDS WHAT ...'");
  }
  event.what = words[3];
  for (auto word = words.begin() + 4; word != words.end(); ++word) {
    const std::size_t equals = word->find('=');
    if (equals == std::string_view::npos) {
      return Fail(ErrorCode::kCorrupt, "'{}' is no KEY=VALUE", word->substr(0, 30));
    }
    event.fields.Add(std::string(word->substr(0, equals)), std::string(word->substr(equals + 1)));
  }
  return event;
}

}  // namespace trailcast::agent
