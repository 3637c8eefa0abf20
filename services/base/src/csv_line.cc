#include "services/base/csv_line.h"

#include <fmt/format.h>

#include <sstream>

#include "services/base/text_file.h"

namespace trailcast {

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::optional<std::vector<std::string>> CsvCells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  return cells;
}

std::vector<std::string> CsvHeader(std::istream& file) {
  std::string line;
  std::getline(file, line);
  std::vector<std::string> names = CsvCells(line).value_or(std::vector<std::string>{line});
  for (std::string& name : names) {
    name.erase(0, name.find_first_not_of(" \t"));
    name.erase(name.find_last_not_of(" \t") + 1);
  }
  return names;
}

CsvLine::CsvLine(const std::vector<std::string>& names, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) cells_[names[i]] = cells[i];
}

void CsvLine::ReadAll(const std::string& name, std::vector<double>& numbers) {
  std::istringstream words(cells_[name]);
  for (std::string word; words >> word;) Parse(name, word, numbers.emplace_back());
}

void CsvLine::Refuse(const std::string& name, const std::string& text) {
  if (trouble_.empty()) trouble_ = fmt::format("{} is '{}', expected a number", name, text);
}

Result<void> ReadCsvTable(const std::filesystem::path& file, const std::string& header,
                          const std::string& what, const std::function<void(CsvLine&)>& read) {
  const auto all = ReadTextFile(file);
  if (!all) return tl::unexpected(all.error());
  std::istringstream in(*all);
  const std::vector<std::string> names = CsvHeader(in);
  if (names != CsvCells(header)) {
    return Fail(ErrorCode::kInvalidArgument, "{} is not {}: expected its first line to be {}",
                file.string(), what, header);
  }
  std::string text;
  for (int number = 2; std::getline(in, text); ++number) {
    const auto cells = CsvCells(text);
    if (!cells || cells->size() != names.size()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: expected {} cells", file.string(),
                  number, names.size());
    }
    CsvLine line(names, *cells);
    read(line);
    if (!line.trouble().empty()) {
      return Fail(ErrorCode::kInvalidArgument, "{}, line {}: {}", file.string(), number,
                  line.trouble());
    }
  }
  return {};
}

}  // namespace trailcast
