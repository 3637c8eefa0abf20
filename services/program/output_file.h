#pragma once

#include <filesystem>

#include "services/base/result.h"

namespace trailcast::program {

// Checks that the folder is there and can be written to, before work that takes minutes. An empty
// path means no file.
[[nodiscard]] Result<void> CanBeWritten(const std::filesystem::path& file);

}  // namespace trailcast::program
