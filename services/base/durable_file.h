#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "services/base/result.h"

namespace trailcast {

// Replaces the file at once, whole, and so that it outlasts a loss of power: who reads it meanwhile
// gets the old one. `mode`: of the new file, less the umask. The error names the file.
[[nodiscard]] Result<void> ReplaceFile(const std::filesystem::path& file, const std::string& text,
                                       mode_t mode = 0644);

// On the disk when it returns: what is in a file, or which names a folder has.
[[nodiscard]] std::error_code SyncToDisk(const std::filesystem::path& path);

// In which the file is, or is to be.
[[nodiscard]] std::filesystem::path FolderOf(const std::filesystem::path& file);

}  // namespace trailcast
