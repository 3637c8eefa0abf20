#pragma once

#include <filesystem>

#include "services/base/result.h"

namespace trailcast::program {

// Whether the folder is there and may be written to: asked before work that takes minutes. An empty
// path is no file at all.
[[nodiscard]] Result<void> CanBeWritten(const std::filesystem::path& file);

}  // namespace trailcast::program
