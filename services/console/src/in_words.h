#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"

namespace trailcast::console {

// Replaces the path of a file by its own name, so that messages tell no other name of this machine.
[[nodiscard]] inline Error InWords(Error error, const std::filesystem::path& path,
                                   const std::string& name) {
  const std::string known = path.string();
  for (std::size_t at = 0; (at = error.message.find(known, at)) != std::string::npos;) {
    error.message.replace(at, known.size(), name);
    at += name.size();
  }
  return error;
}

}  // namespace trailcast::console
