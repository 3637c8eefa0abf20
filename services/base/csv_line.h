#pragma once

#include <filesystem>
#include <functional>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/base/number.h"
#include "services/base/result.h"

namespace trailcast {

// Returns `text` as one cell, quoted if a comma, a quote or a line's end in it requires that.
[[nodiscard]] std::string CsvText(const std::string& text);

// Returns the cells of one line, or nothing if a quote is not closed.
[[nodiscard]] std::optional<std::vector<std::string>> CsvCells(const std::string& line);

// Reads a file's first line as the names of its columns, without the blanks around them. An empty
// file gives one empty cell.
[[nodiscard]] std::vector<std::string> CsvHeader(std::istream& file);

// Reads one line's cells by the names of their columns. It keeps the first cell that cannot be read
// as the line's trouble.
class CsvLine {
 public:
  CsvLine(const std::vector<std::string>& names, const std::vector<std::string>& cells);

  [[nodiscard]] const std::string& Text(const std::string& name) { return cells_[name]; }
  template <typename Number>
  void Read(const std::string& name, Number& number) {
    Parse(name, cells_[name], number);
  }
  // Reads numbers that are separated by blanks.
  void ReadAll(const std::string& name, std::vector<double>& numbers);
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  template <typename Number>
  void Parse(const std::string& name, const std::string& text, Number& number) {
    if (!ReadNumber(text, number)) Refuse(name, text);
  }
  void Refuse(const std::string& name, const std::string& text);

  std::map<std::string, std::string> cells_;
  std::string trouble_;
};

// Calls `read` for each line of a file whose first line has to be `header`. Errors name such a file
// as `what` does. kInvalidArgument says which line cannot be read, and why.
[[nodiscard]] Result<void> ReadCsvTable(const std::filesystem::path& file,
                                        const std::string& header, const std::string& what,
                                        const std::function<void(CsvLine&)>& read);

}  // namespace trailcast
