#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trailcast::console {

// This is a file of the page, embedded in this program.
struct File {
  const char* path;  // the path of its requests
  const char* type;
  std::string_view bytes;
  std::string_view packed{};  // by gzip; empty if it is not packed
  std::string tag;            // differs for other bytes; in quotes, as HTTP has it
};
[[nodiscard]] std::span<const File> Files();

}  // namespace trailcast::console
