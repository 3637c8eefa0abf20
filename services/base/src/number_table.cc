#include "services/base/number_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "services/base/csv_line.h"
#include "services/base/number.h"
#include "services/base/text_file.h"

namespace trailcast {
namespace {

std::optional<double> Number(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t");
  if (from == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_last_not_of(" \t") + 1;
  const auto value = ParseNumber<double>(std::string_view(text).substr(from, end - from));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Returns each column's place in the header, or nothing if one is missing.
std::optional<std::vector<std::size_t>> PlacesOf(const std::vector<std::string>& names,
                                                 const std::vector<std::string>& columns,
                                                 const std::vector<std::string>& optional) {
  std::vector<std::size_t> places;
  for (const std::vector<std::string>* each : {&columns, &optional}) {
    for (const std::string& column : *each) {
      const auto found = std::find(names.begin(), names.end(), column);
      if (found != names.end()) places.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    if (each == &columns && places.size() != columns.size()) return std::nullopt;
  }
  return places;
}

// A file that is no table may have lines of any length, which a message must not repeat.
std::string Clipped(const std::string& text) {
  constexpr std::size_t kMostShown = 200;
  if (text.size() <= kMostShown) return text;
  return fmt::format("{}...", std::string_view(text).substr(0, kMostShown));
}

}  // namespace

Result<std::vector<NumberRow>> ReadNumbers(const std::filesystem::path& file,
                                           const std::vector<std::string>& columns,
                                           const std::vector<std::string>& optional) {
  const auto text = ReadTextFile(file);
  if (!text) return tl::unexpected(text.error());
  std::istringstream stream(*text);
  const std::vector<std::string> names = CsvHeader(stream);
  const auto places = PlacesOf(names, columns, optional);
  if (!places) {
    const std::string has = fmt::format("{}", fmt::join(names, ","));
    return Fail(ErrorCode::kInvalidArgument,
                "{}, line 1: expected a header with the columns {}, separated by commas; it {}",
                file.string(), fmt::join(columns, ","),
                has.empty() ? "is empty" : "has " + Clipped(has));
  }
  std::vector<NumberRow> rows;
  std::string line;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto cells = CsvCells(line);
    if (!cells || cells->size() != names.size()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: {} columns; expected the {} of '{}'",
                  file.string(), number, cells ? cells->size() : 0, names.size(),
                  fmt::join(names, ","));
    }
    NumberRow& row = rows.emplace_back(NumberRow{number, {}});
    for (const std::size_t place : *places) {
      const auto value = Number((*cells)[place]);
      if (!value) {
        return Fail(ErrorCode::kInvalidArgument,
                    "{}, line {}: expected a number under '{}', not '{}'", file.string(), number,
                    names[place], Clipped((*cells)[place]));
      }
      row.cells.push_back(*value);
    }
  }
  return rows;
}

}  // namespace trailcast
