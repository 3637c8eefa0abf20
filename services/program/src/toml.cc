#include "services/program/toml.h"

#include <fmt/format.h>

#include <set>
#include <sstream>
#include <string>

#include "services/base/text_file.h"

namespace trailcast::program {
namespace {

// Returns the line up to the first '#' outside of quotes, without the blanks before it.
std::string WithoutComment(const std::string& line) {
  char quote = 0;
  std::size_t end = 0;
  for (; end < line.size(); ++end) {
    const char c = line[end];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      break;
    }
  }
  const std::size_t last = line.find_last_not_of(" \t\r", end == 0 ? 0 : end - 1);
  return end == 0 || last == std::string::npos ? "" : line.substr(0, last + 1);
}

// Finds keys that a section has twice.
class Keys {
 public:
  // Takes the lines one by one.
  void Take(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos) return;
    if (line[begin] == '[') {
      section_ = line.substr(begin);
      return;
    }
    const std::size_t equals = line.find('=', begin);
    if (equals == std::string::npos) return;  // a part of an array, or no TOML
    std::string key = line.substr(begin, equals - begin);
    key.erase(key.find_last_not_of(" \t") + 1);
    if (seen_.insert(section_ + ' ' + key).second) return;
    throw CLI::ConfigError(fmt::format("the configuration file has the key '{}' twice{}: keep one",
                                       key, section_.empty() ? "" : " in " + section_));
  }

 private:
  std::string section_;
  std::set<std::string> seen_;
};

}  // namespace

std::vector<CLI::ConfigItem> Toml::from_config(std::istream& input) const {
  const auto text = ReadText(input);
  if (!text)
    throw CLI::ConfigError("the configuration file cannot be read: " + text.error().message);
  std::istringstream plain(*text);
  std::stringstream without_comments;
  Keys keys;
  for (std::string line; std::getline(plain, line);) {
    line = WithoutComment(line);
    keys.Take(line);
    without_comments << line << '\n';
  }
  CLI::ConfigTOML reader;
  reader.comment('\0');  // comments are already removed
  return reader.from_config(without_comments);
}

}  // namespace trailcast::program
