#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "services/base/result.h"

namespace trailcast::security {

inline constexpr mode_t kForOwner = 0600;      // keys
inline constexpr mode_t kForEverybody = 0644;  // certificates, signed documents

// Does as ReadBoundedFile, with a bound for keys and what is signed with them.
[[nodiscard]] Result<std::string> ReadSmallFile(const std::filesystem::path& file);
// Makes a folder, with its parents, that only its owner may enter.
[[nodiscard]] Result<void> MakePrivateFolder(const std::filesystem::path& folder);

}  // namespace trailcast::security
