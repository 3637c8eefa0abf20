#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace trailcast {

// Names are whatever users' files have; in a file's name only what every shell leaves alone.
[[nodiscard]] inline std::string ForFileName(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-'; },
      '_');
  return text;
}

}  // namespace trailcast
