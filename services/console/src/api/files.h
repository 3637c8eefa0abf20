#pragma once

#include <span>
#include <string>
#include <string_view>

namespace trailcast::console {

// A file of the page, in this program.
struct File {
  const char* path;  // as it is asked for
  const char* type;
  std::string_view bytes;
  std::string_view packed{};  // by gzip; empty: it is not
  std::string tag;            // other bytes have another; in quotes, as HTTP has it
};
[[nodiscard]] std::span<const File> Files();

}  // namespace trailcast::console
