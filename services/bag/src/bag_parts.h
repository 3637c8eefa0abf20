#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bag {

// The files of a recording: the file itself, or every .db3 and .mcap of a folder, plain or with
// .zstd added. A folder's file is left out if rosbag2's metadata.yaml does not list it and its name
// differs from those listed.
struct BagParts {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> differences;   // differences from metadata.yaml, and gaps, a line each
  std::optional<std::uint64_t> messages;  // number of messages by metadata.yaml
};
[[nodiscard]] Result<BagParts> FindParts(const std::filesystem::path& file_or_folder);

}  // namespace trailcast::bag
