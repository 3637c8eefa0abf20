#pragma once

#include <sys/types.h>

#include <cstddef>
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

// Reads a whole file. Errors name it: kNotFound, kUnavailable for one that cannot be read, kCorrupt
// for one that is larger than `most_bytes`, and for a folder, a pipe or a device.
[[nodiscard]] Result<std::string> ReadBoundedFile(const std::filesystem::path& file,
                                                  std::size_t most_bytes);

// Returns once a file's contents, or the names in a folder, are on the disk.
[[nodiscard]] std::error_code SyncToDisk(const std::filesystem::path& path);

// Returns the folder that holds the file, or will hold it.
[[nodiscard]] std::filesystem::path FolderOf(const std::filesystem::path& file);

}  // namespace trailcast
