#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"

namespace trailcast {

// Replaces the file's contents. The error names the file.
[[nodiscard]] Result<void> WriteTextFile(const std::filesystem::path& file,
                                         const std::string& text);

}  // namespace trailcast
