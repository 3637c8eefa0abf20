#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "services/base/result.h"

namespace trailcast {

// Replaces the whole file in one step that outlasts a loss of power: a program that reads it
// meanwhile gets the old contents. The new file has `mode`, less the umask. The error names the
// file.
[[nodiscard]] Result<void> ReplaceFile(const std::filesystem::path& file, const std::string& text,
                                       mode_t mode = 0644);

// Returns once a file's contents, or the names in a folder, are on the disk.
[[nodiscard]] std::error_code SyncToDisk(const std::filesystem::path& path);

// Returns the folder that holds the file, or will hold it.
[[nodiscard]] std::filesystem::path FolderOf(const std::filesystem::path& file);

}  // namespace trailcast
