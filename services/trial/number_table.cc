#include "services/trial/number_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string_view>

namespace trailcast::trial {
namespace {

std::vector<std::string_view> Cells(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (std::size_t from = 0;;) {
    const std::size_t comma = line.find(',', from);
    cells.push_back(line.substr(from, comma - from));
    if (comma == std::string_view::npos) return cells;
    from = comma + 1;
  }
}

std::optional<double> Number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc{} && end == text.data() + text.size();
  if (!whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Where each of the columns is in the header; nothing if one is missing.
std::optional<std::vector<std::size_t>> PlacesOf(const std::vector<std::string>& columns,
                                                 const std::string& header) {
  const std::vector<std::string_view> names = Cells(header);
  std::vector<std::size_t> places;
  for (const std::string& column : columns) {
    const auto found = std::find(names.begin(), names.end(), column);
    if (found == names.end()) return std::nullopt;
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return places;
}

}  // namespace

Result<std::vector<std::vector<double>>> ReadNumbers(const std::filesystem::path& file,
                                                     const std::vector<std::string>& columns) {
  std::ifstream stream(file);
  if (!stream) return Fail(ErrorCode::kNotFound, "cannot read {}", file.string());
  std::string line;
  std::getline(stream, line);
  const auto places = PlacesOf(columns, line);
  if (!places) {
    return Fail(ErrorCode::kInvalidArgument, "{}, line 1: expected a header with the columns {}",
                file.string(), fmt::join(columns, ","));
  }
  std::vector<std::vector<double>> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::vector<std::string_view> cells = Cells(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto value =
          (*places)[i] < cells.size() ? Number(cells[(*places)[i]]) : std::optional<double>();
      if (!value) {
        return Fail(ErrorCode::kInvalidArgument, "{}, line {}: expected a number under '{}'",
                    file.string(), number, columns[i]);
      }
      row.push_back(*value);
    }
  }
  return rows;
}

}  // namespace trailcast::trial
