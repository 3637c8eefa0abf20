#include "services/bag/src/bag_parts.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace trailcast::bag {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLines = 1'000'000;

struct Metadata {
  std::vector<std::string> files;
  std::optional<std::uint64_t> messages;
};

std::optional<std::uint64_t> NumberIn(const std::string& text) {
  std::uint64_t number = 0;
  const std::size_t from = std::min(text.find_first_not_of(' '), text.size());
  const auto [end, error] = std::from_chars(text.data() + from, text.data() + text.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

// Below "relative_file_paths:" there is one name a line, as "    - drive_0.db3". Some versions put
// the folder's name before it. The first "message_count:" counts all messages.
Metadata ReadMetadata(const fs::path& file) {
  const std::string count = "message_count:";
  Metadata metadata;
  std::ifstream stream(file);
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
      metadata.files.push_back(fs::path(text.substr(2)).filename().string());
      continue;
    }
    listing = text.rfind("relative_file_paths:", 0) == 0;
    if (!metadata.messages && text.rfind(count, 0) == 0) {
      metadata.messages = NumberIn(text.substr(count.size()));
    }
  }
  return metadata;
}

// Returns the file's name without the ending that says it is compressed.
fs::path PlainName(const fs::path& file) {
  return file.extension() == ".zstd" ? file.stem() : file.filename();
}

// macOS keeps its notes on a file in a hidden one beside it with the same ending.
bool IsPart(const fs::path& file) {
  const fs::path name = PlainName(file);
  return name.string().front() != '.' &&
         (name.extension() == ".db3" || name.extension() == ".mcap");
}

// Returns "drive" for "drive_12.db3": recorders number the files of one recording.
std::string SeriesOf(const fs::path& file) {
  const std::string stem = PlainName(file).stem().string();
  const std::size_t number = stem.find_last_not_of("0123456789");
  const bool numbered =
      number != std::string::npos && number + 1 < stem.size() && stem[number] == '_';
  return numbered ? stem.substr(0, number) : stem;
}

// Returns 12 for "drive_12.db3", and nothing for a date or a time, which recorders use as well.
std::optional<std::uint64_t> NumberInSeries(const fs::path& file) {
  constexpr std::size_t kMostDigits = 4;
  const std::string stem = PlainName(file).stem().string();
  const std::size_t from = SeriesOf(file).size() + 1;
  if (from >= stem.size() || stem.size() - from > kMostDigits) return std::nullopt;
  return NumberIn(stem.substr(from));
}

// Gaps in the numbers are the only sign that an unlisted file is missing.
void NoteGaps(const std::set<fs::path>& listed, BagParts& parts) {
  std::map<std::pair<std::string, std::uint64_t>, fs::path> numbered;
  const auto add = [&](const fs::path& file) {
    if (const auto number = NumberInSeries(file)) {
      numbered.emplace(std::pair(SeriesOf(file), *number), file.filename());
    }
  };
  std::for_each(listed.begin(), listed.end(), add);
  std::for_each(parts.files.begin(), parts.files.end(), add);
  for (auto at = numbered.begin(); at != numbered.end(); ++at) {
    const auto next = std::next(at);
    if (next == numbered.end()) break;
    const auto& [series, number] = at->first;
    const bool gap = next->first.first == series && next->first.second > number + 1;
    if (!gap || listed.contains(PlainName(next->second))) continue;
    parts.differences.push_back(
        fmt::format("{}_{}: not there, nor what else there was between {} and {}: that part of the "
                    "drive is left out",
                    series, number + 1, at->second.string(), next->second.string()));
  }
}

// Players unpack files beside the packed ones.
std::optional<fs::path> PackedOrNot(const fs::path& file) {
  std::error_code unknown;
  if (fs::exists(file, unknown)) return file;
  if (file.extension() != ".zstd") return std::nullopt;
  const fs::path unpacked = file.parent_path() / file.stem();
  return fs::exists(unpacked, unknown) ? std::optional(unpacked) : std::nullopt;
}

// Returns all recordings in the folder, each once.
std::vector<fs::path> RecordingsIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const fs::path& file = entry->path();
    const bool packed = file.extension() == ".zstd";
    const bool twice = packed && fs::exists(file.parent_path() / file.stem());
    if (IsPart(file) && !twice) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Metadata is written when a recording ends, so it may be older than the files or have their former
// names. If listed files are missing, unlisted ones take their place.
BagParts OfFolder(const fs::path& folder) {
  BagParts parts;
  const Metadata metadata = ReadMetadata(folder / "metadata.yaml");
  parts.messages = metadata.messages;
  std::set<fs::path> listed;
  std::set<std::string> series;
  for (const std::string& name : metadata.files) {
    listed.insert(PlainName(name));
    series.insert(SeriesOf(name));
    if (const auto file = PackedOrNot(folder / name)) {
      parts.files.push_back(*file);
    } else {
      parts.differences.push_back(name + ": listed in metadata.yaml, but not there");
    }
  }
  const bool lacking = !parts.differences.empty();
  for (const fs::path& file : RecordingsIn(folder)) {
    if (listed.contains(PlainName(file))) continue;
    const bool taken = metadata.files.empty() || lacking || series.contains(SeriesOf(file));
    if (taken) parts.files.push_back(file);
    if (metadata.files.empty()) continue;
    parts.differences.push_back(
        fmt::format("{}: not listed in metadata.yaml, {}", file.filename().string(),
                    taken ? "but read" : "and of another name than what is: left out"));
  }
  NoteGaps(listed, parts);
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
  if (!fs::is_directory(file_or_folder, failed)) return BagParts{{file_or_folder}, {}, {}};
  BagParts parts = OfFolder(file_or_folder);
  if (parts.files.empty()) {
    return Fail(ErrorCode::kNotFound,
                "the folder {} has no recording: expected files ending in .db3 or .mcap{}",
                file_or_folder.string(),
                parts.differences.empty() ? "" : ", as its metadata.yaml lists them");
  }
  return parts;
}

}  // namespace trailcast::bag
