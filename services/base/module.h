#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast {

// Returns the address of `symbol` in one of the project's own libraries that programs load only
// when they need them, because of what these link. `library` is a file name. It is sought in the
// folder that TRAILCAST_MODULES names, beside the program, in ../lib/trailcast, and in the
// installation's folder. The library stays loaded until the process ends. The error is
// kUnavailable, with the loader's words.
[[nodiscard]] Result<void*> FindInModule(const std::string& library, const std::string& symbol);

}  // namespace trailcast
