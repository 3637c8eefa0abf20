#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bag {

// The files of a recording: the file itself, or every .db3 and .mcap of a folder, plain or with
// .zstd behind, but for those that its metadata.yaml, as rosbag2 writes it, does not list, and that
// are named otherwise than those listed.
struct BagParts {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> differences;   // from what metadata.yaml lists, and gaps, a line each
  std::optional<std::uint64_t> messages;  // that metadata.yaml counts
};
[[nodiscard]] Result<BagParts> FindParts(const std::filesystem::path& file_or_folder);

}  // namespace trailcast::bag
