#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast::console {

// Reads a line of standard input. On a terminal it shows `prompt`, and does not show the line.
// Fails with kInvalidArgument at the end of input.
[[nodiscard]] Result<std::string> ReadPassword(const std::string& prompt);

}  // namespace trailcast::console
