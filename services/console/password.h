#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast::console {

// A line of standard input; from a terminal after `prompt`, and not shown. kInvalidArgument at the
// end of input.
[[nodiscard]] Result<std::string> ReadPassword(const std::string& prompt);

}  // namespace trailcast::console
