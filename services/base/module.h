#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast {

// The address of `symbol` in a library of the project's own that programs load only when they need
// it, because of what it links: `library`, a file name, in the folder that TRAILCAST_MODULES names,
// beside the program, in ../lib/trailcast, or where this was installed to. It stays loaded until
// the process ends. Error: kUnavailable, with the loader's words.
[[nodiscard]] Result<void*> FindInModule(const std::string& library, const std::string& symbol);

}  // namespace trailcast
