#pragma once

#include <cstdint>
#include <string>

namespace trailcast::fleet {

// From the system's random source: operators' processes in containers have the same number, and
// thus the same name. 1 or more.
[[nodiscard]] std::uint64_t DrawNumber();
// 16 hexadecimal digits.
[[nodiscard]] std::string DrawMissionId();

}  // namespace trailcast::fleet
