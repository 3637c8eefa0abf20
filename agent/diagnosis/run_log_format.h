#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "services/base/result.h"

namespace trailcast::agent {

// The text of a replay's log, line by line; agent/diagnosis/README.md shows one.
//
//   # trailcast replay log 1            first line: what this is, and the format's version
//   # route hall                        then what is known of the run, a key and its value a line
//   # columns frame t_s segment ...     the last of the header: what the rows hold
//   12 0.400 0 0.130 ...                a frame; "-": there is no such thing
//   ! 12 0.400 hand-over segment=0 found=28 : some text
//                                       an event in frame 12, or just after it
inline constexpr int kRunLogVersion = 1;
// Longer lines are damage.
inline constexpr std::size_t kLongestLogLine = 2000;

[[nodiscard]] std::string FirstLine();
[[nodiscard]] std::string HeaderText(const Fields& header);  // with the columns
[[nodiscard]] std::string RowText(const FrameRow& row);
[[nodiscard]] std::string EventText(const RunEvent& event);
// Of its text, what happened: without the frame, the time and the line's end.
[[nodiscard]] std::string DescribeEvent(const RunEvent& event);

// What a row holds, in the order of the columns; the phase as its number.
using Cell = std::optional<std::variant<int, double>>;
[[nodiscard]] std::vector<Cell> CellsOf(const FrameRow& row);
[[nodiscard]] std::vector<std::string> ColumnNames();

// Errors are kCorrupt and say what is wrong with the line.
[[nodiscard]] Result<void> CheckFirstLine(std::string_view line);
// The columns' names of a row, as the header lists them: there may be some that this version does
// not know; none of its own may be missing.
[[nodiscard]] Result<std::vector<std::string>> ParseColumns(std::string_view names);
[[nodiscard]] Result<FrameRow> ParseRow(std::string_view line,
                                        const std::vector<std::string>& columns);
[[nodiscard]] Result<RunEvent> ParseEvent(std::string_view line);

[[nodiscard]] std::vector<std::string_view> Words(std::string_view line);

}  // namespace trailcast::agent
