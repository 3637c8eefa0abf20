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

// In quotes where it has to be.
[[nodiscard]] std::string CsvText(const std::string& text);

// The cells of one line; nothing where a quote is not closed.
[[nodiscard]] std::optional<std::vector<std::string>> CsvCells(const std::string& line);

// The names of a file's columns, by its first line, without blanks about them. Empty cells where
// the file is empty.
[[nodiscard]] std::vector<std::string> CsvHeader(std::istream& file);

// One line by the names of its columns. The first cell that is not what it should be is kept as
// the line's trouble.
class CsvLine {
 public:
  CsvLine(const std::vector<std::string>& names, const std::vector<std::string>& cells);

  [[nodiscard]] const std::string& Text(const std::string& name) { return cells_[name]; }
  template <typename Number>
  void Read(const std::string& name, Number& number) {
    Parse(name, cells_[name], number);
  }
  // Numbers with blanks between.
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

// Each line of a file whose first line has to be `header`. `what`: for people, what such a file is.
// kInvalidArgument says which line is not what it should be, and why.
[[nodiscard]] Result<void> ReadCsvTable(const std::filesystem::path& file,
                                        const std::string& header, const std::string& what,
                                        const std::function<void(CsvLine&)>& read);

}  // namespace trailcast
