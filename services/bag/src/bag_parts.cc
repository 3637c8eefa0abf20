#include "services/bag/src/bag_parts.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

namespace trailcast::bag {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLines = 1'000'000;

// Below "relative_file_paths:" one name a line, as "    - drive_0.db3". Some versions put the
// folder's name before it.
std::vector<std::string> ListedFiles(const fs::path& metadata) {
  std::vector<std::string> names;
  std::ifstream stream(metadata);
  bool listing = false;
  std::string line;
  for (std::size_t i = 0; i < kMostLines && std::getline(stream, line); ++i) {
    const std::size_t begin = line.find_first_not_of(" ");
    if (begin == std::string::npos) continue;
    std::string text = line.substr(begin);
    text.erase(std::remove_if(text.begin(), text.end(),
                              [](char c) { return c == '"' || c == '\'' || c == '\r'; }),
               text.end());
    if (listing && text.rfind("- ", 0) == 0) {
      names.push_back(fs::path(text.substr(2)).filename().string());
    } else {
      listing = text.rfind("relative_file_paths:", 0) == 0;
    }
  }
  return names;
}

bool IsPart(const fs::path& file) {
  const fs::path name = file.extension() == ".zstd" ? file.stem() : file.filename();
  return name.extension() == ".db3" || name.extension() == ".mcap";
}

// Players unpack files beside themselves.
std::optional<fs::path> PackedOrNot(const fs::path& file) {
  std::error_code unknown;
  if (fs::exists(file, unknown)) return file;
  if (file.extension() != ".zstd") return std::nullopt;
  const fs::path unpacked = file.parent_path() / file.stem();
  return fs::exists(unpacked, unknown) ? std::optional(unpacked) : std::nullopt;
}

BagParts OfFolder(const fs::path& folder) {
  BagParts parts;
  const auto names = ListedFiles(folder / "metadata.yaml");
  for (const std::string& name : names) {
    if (const auto file = PackedOrNot(folder / name)) {
      parts.files.push_back(*file);
    } else {
      parts.missing.push_back(name);
    }
  }
  if (!names.empty()) return parts;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const fs::path& file = entry->path();
    const bool packed = file.extension() == ".zstd";
    const bool twice = packed && fs::exists(file.parent_path() / file.stem());
    if (IsPart(file) && !twice) parts.files.push_back(file);
  }
  return parts;
}

}  // namespace

Result<BagParts> FindParts(const fs::path& file_or_folder) {
  std::error_code failed;
  if (!fs::exists(file_or_folder, failed)) {
    return Fail(ErrorCode::kNotFound,
                "no recording at {}: expected a file (.db3, .mcap) or the folder of a rosbag2 "
                "recording",
                file_or_folder.string());
  }
  if (!fs::is_directory(file_or_folder, failed)) return BagParts{{file_or_folder}, {}};
  BagParts parts = OfFolder(file_or_folder);
  if (parts.files.empty()) {
    return Fail(ErrorCode::kNotFound,
                "the folder {} has no recording: expected files ending in .db3 or .mcap{}",
                file_or_folder.string(),
                parts.missing.empty() ? "" : ", as its metadata.yaml lists them");
  }
  return parts;
}

}  // namespace trailcast::bag
