#pragma once

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/places.h"

// This reads the sources of libraries and programs as text: which room each line is in, and what it
// includes.
namespace trailcast {

struct Include {
  std::string room;   // "services/vision", "agent/link", "route_server"
  std::string where;  // file:line
  std::string header;
  bool quoted = false;
};

struct SourceLine {
  std::string room;
  std::string where;
  std::string text;
};

// The room of a file or header is told by its path from the root: it is the folder below agent/,
// route_server/, services/ or services/lab/ that it lies in.
inline std::string RoomOf(const std::string& path) {
  const std::string lab = "services/lab/";
  const std::size_t below = path.starts_with(lab) ? lab.size() : path.find('/') + 1;
  const std::size_t end = path.find('/', below);
  return path.substr(0, end == std::string::npos ? below - 1 : end);
}

inline std::vector<SourceLine> ReadSources(std::initializer_list<const char*> folders = {
                                               "services", "agent", "route_server"}) {
  const std::filesystem::path root(SourceDir());
  std::vector<SourceLine> lines;
  for (const char* top : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc" && extension != ".c") continue;
      const std::filesystem::path path = entry.path().lexically_relative(root);
      const std::string room = RoomOf(path.string());
      std::ifstream in(entry.path());
      std::string text;
      for (int number = 1; std::getline(in, text); ++number) {
        lines.push_back({room, path.string() + ":" + std::to_string(number), text});
      }
    }
  }
  return lines;
}

inline std::vector<Include> FindIncludes(const std::vector<SourceLine>& lines) {
  const auto after = [](const std::string& text, std::string_view word) -> std::string {
    const std::size_t start = text.find_first_not_of(" \t");
    if (start == std::string::npos || !text.substr(start).starts_with(word)) return "";
    return text.substr(start + word.size());
  };
  std::vector<Include> includes;
  for (const SourceLine& line : lines) {
    const std::string rest = after(after(line.text, "#"), "include");
    const std::size_t open = rest.find_first_of("<\"");
    if (open == std::string::npos) continue;
    const bool quoted = rest[open] == '"';
    const std::size_t close = rest.find(quoted ? '"' : '>', open + 1);
    includes.push_back({line.room, line.where, rest.substr(open + 1, close - open - 1), quoted});
  }
  return includes;
}

}  // namespace trailcast
