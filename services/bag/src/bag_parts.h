#pragma once

#include <filesystem>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bag {

// The files of a recording: the file itself, or those of a folder. Where that has rosbag2's
// metadata.yaml, the files listed there, of which `missing` are not there; else every .db3 and
// .mcap, plain or with .zstd behind.
struct BagParts {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> missing;
};
[[nodiscard]] Result<BagParts> FindParts(const std::filesystem::path& file_or_folder);

}  // namespace trailcast::bag
