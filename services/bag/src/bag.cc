#include "services/bag/bag.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <tuple>
#include <utility>

#include "services/bag/compression.h"
#include "services/bag/src/bag_file.h"
#include "services/bag/src/bag_parts.h"
#include "services/bag/src/db3_file.h"
#include "services/bag/src/mcap_file.h"
#include "services/base/work_folder.h"

namespace trailcast::bag {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSqlite = "SQLite format 3";
constexpr std::size_t kBeginningBytes = 18;

Bytes Beginning(const fs::path& file) {
  Bytes bytes(kBeginningBytes);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return bytes;
}

bool BeginsWith(const Bytes& bytes, std::string_view magic) {
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())
             .substr(0, magic.size()) == magic;
}

template <typename File>
Result<std::unique_ptr<BagFile>> OpenAs(const fs::path& file) {
  auto opened = File::Open(file);
  if (!opened) return tl::unexpected(opened.error());
  return std::unique_ptr<BagFile>(std::move(*opened));
}

// The file's beginning decides its format, whatever its name is.
Result<std::unique_ptr<BagFile>> OpenFile(const fs::path& file) {
  const Bytes beginning = Beginning(file);
  if (beginning.size() >= kMcapMagic.size() &&
      std::equal(kMcapMagic.begin(), kMcapMagic.end(), beginning.begin())) {
    return OpenAs<McapFile>(file);
  }
  if (BeginsWith(beginning, kSqlite)) return OpenAs<Db3File>(file);
  if (BeginsWith(beginning, "#ROSBAG")) {
    return Fail(
        ErrorCode::kInvalidArgument,
        "{} is a ROS 1 recording: make an MCAP or ROS 2 one of it first (as 'rosbags-convert' "
        "does)",
        file.string());
  }
  return Fail(ErrorCode::kInvalidArgument,
              "{} is no recording that is understood: expected rosbag2's SQLite (.db3) or MCAP, "
              "plain or compressed with zstd",
              file.string());
}

}  // namespace

struct Bag::Part {
  fs::path name;  // as the user knows it
  std::optional<WorkFolder> scratch;
  std::unique_ptr<BagFile> file;
  Contents contents;
};

Bag::Bag() = default;
Bag::~Bag() = default;

Result<std::unique_ptr<Bag>> Bag::Open(const fs::path& file_or_folder, const Tell& tell,
                                       std::optional<std::uint64_t> most_growth) {
  const auto parts = FindParts(file_or_folder);
  if (!parts) return tl::unexpected(parts.error());
  std::unique_ptr<Bag> bag(new Bag());
  for (const std::string& difference : parts->differences) bag->Note(difference);
  for (const fs::path& file : parts->files) {
    auto added = bag->Add(file, tell, most_growth);
    if (added) continue;
    const ErrorCode code = added.error().code;
    const bool its_own = code == ErrorCode::kCorrupt || code == ErrorCode::kInvalidArgument;
    if (!its_own || parts->files.size() == 1) return tl::unexpected(added.error());
    bag->Note(added.error().message);
  }
  if (bag->parts_.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "no file of {} can be read: {}",
                file_or_folder.string(), fmt::join(bag->damage_, "; "));
  }
  std::stable_sort(bag->parts_.begin(), bag->parts_.end(), [](const Part& a, const Part& b) {
    return a.contents.first_at < b.contents.first_at;
  });
  bag->Collect();
  std::uint64_t messages = 0;
  for (const Topic& topic : bag->topics_) messages += topic.messages;
  if (bag->damage_.empty() && parts->messages.value_or(0) > messages) {
    bag->Note(fmt::format("metadata.yaml counts {} messages, of which {} are there",
                          *parts->messages, messages));
  }
  return bag;
}

// Returns the file to read: the part itself or, if it is compressed, an unpacked copy.
Result<fs::path> Bag::Unpack(Part& part, const Tell& tell) {
  if (!IsZstd(Beginning(part.name))) return part.name;
  tell(fmt::format("unpacking {}", part.name.string()));
  auto plain = InScratch(part, part.name.stem());
  if (!plain) return plain;
  const auto whole = DecompressZstdFile(part.name, *plain);
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) Note(part.name.filename().string() + ": its compression breaks off");
  return plain;
}

// Returns a database, or a copy without its last page if that was cut off.
Result<fs::path> Bag::CutToPages(Part& part, const fs::path& plain, const Tell& tell) {
  std::error_code failed;
  const Bytes beginning = Beginning(plain);
  const auto size = fs::file_size(plain, failed);
  const auto whole = Db3File::WholeBytes(size, beginning);
  if (failed || !BeginsWith(beginning, kSqlite) || whole == size) return plain;
  fs::path copy = plain;
  if (!part.scratch) {
    tell(fmt::format("{} was cut off: copying what is whole", plain.string()));
    auto made = InScratch(part, plain.filename());
    if (!made) return made;
    copy = std::move(*made);
    fs::copy_file(plain, copy, failed);
  }
  if (!failed) fs::resize_file(copy, whole, failed);
  if (!failed) return copy;
  return Fail(ErrorCode::kUnavailable,
              "{} cannot be copied into {}: {} (TMPDIR names another folder)", plain.string(),
              copy.parent_path().string(), failed.message());
}

Result<fs::path> Bag::InScratch(Part& part, const fs::path& name) {
  auto folder = WorkFolder::Make();
  if (!folder) return tl::unexpected(folder.error());
  part.scratch = std::move(*folder);
  return *part.scratch / name.string();
}

Result<void> Bag::Add(const fs::path& file, const Tell& tell,
                      std::optional<std::uint64_t> most_growth) {
  Part part{file, {}, nullptr, {}};
  auto plain = Unpack(part, tell);
  if (plain) plain = CutToPages(part, *plain, tell);
  if (!plain) return tl::unexpected(plain.error());
  auto opened = OpenFile(*plain);
  if (!opened) return tl::unexpected(opened.error());
  part.file = std::move(*opened);
  part.file->Bound(most_growth);
  auto contents = part.file->Survey(tell);
  if (!contents) return tl::unexpected(contents.error());
  part.contents = std::move(*contents);
  NoteDamage(part);
  parts_.push_back(std::move(part));
  return {};
}

// A topic of the same name and type in several files and channels is one.
void Bag::Collect() {
  for (const Part& part : parts_) {
    for (const Topic& topic : part.contents.topics) {
      const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const Topic& known) {
        return known.name == topic.name && known.type == topic.type;
      });
      if (same == topics_.end()) {
        topics_.push_back(topic);
      } else {
        same->messages += topic.messages;
      }
    }
  }
  std::sort(topics_.begin(), topics_.end(), [](const Topic& a, const Topic& b) {
    return std::tie(a.name, a.type) < std::tie(b.name, b.type);
  });
}

void Bag::Begin(const Topic& topic, std::chrono::nanoseconds from) {
  current_ = 0;
  for (Part& part : parts_) part.file->Begin(topic, from);
}

std::chrono::nanoseconds Bag::last_at() const {
  std::chrono::nanoseconds last{};
  for (const Part& part : parts_) last = std::max(last, part.contents.last_at);
  return last;
}

Result<std::optional<Message>> Bag::Next() {
  while (current_ < parts_.size()) {
    Part& part = parts_[current_];
    auto message = part.file->Next();
    NoteDamage(part);
    if (!message || *message) return message;
    ++current_;
  }
  return std::nullopt;
}

// Damage is noted once, however often the file is read.
void Bag::NoteDamage(Part& part) {
  for (const std::string& what : part.file->TakeDamage()) {
    Note(part.name.filename().string() + ": " + what);
  }
}

void Bag::Note(std::string line) {
  const bool known = std::find(damage_.begin(), damage_.end(), line) != damage_.end();
  if (!known && damage_.size() < kMostDamage) damage_.push_back(std::move(line));
}

}  // namespace trailcast::bag
