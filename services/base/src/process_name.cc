#include "services/base/process_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace trailcast {

std::string ProcessName(const std::string& member, long process) {
  return fmt::format("{}-p{}", member, process);
}

std::string WithoutProcess(const std::string& name) {
  const std::size_t mark = name.rfind("-p");
  if (mark == std::string::npos || mark + 2 == name.size()) return name;
  const bool number = std::all_of(name.begin() + static_cast<std::ptrdiff_t>(mark) + 2, name.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  return number ? name.substr(0, mark) : name;
}

}  // namespace trailcast
