#pragma once

#include <cstdint>
#include <string>

namespace trailcast::fleet {

// Returns a number from the system's random source, at least 1. Processes of operators in
// containers have the same process number, and thus the same name, so that does not tell them
// apart.
[[nodiscard]] std::uint64_t DrawNumber();
// Returns 16 hexadecimal digits.
[[nodiscard]] std::string DrawMissionId();

}  // namespace trailcast::fleet
