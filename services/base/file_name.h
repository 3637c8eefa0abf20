#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace trailcast {

// Replaces every character of a user's name that some shell treats specially, so that the text can
// be part of a file's name.
[[nodiscard]] inline std::string ForFileName(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-'; },
      '_');
  return text;
}

}  // namespace trailcast
