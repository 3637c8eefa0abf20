#include "services/store/src/salvage/sqlite_pages.h"

#include <algorithm>
#include <array>
#include <span>

#include "services/store/src/salvage/big_endian.h"
#include "services/store/src/salvage/sqlite_header.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

constexpr std::uint32_t kLeastPage = 512;
constexpr std::uint32_t kLeastUsable = 480;
// "The Write-Ahead Log".
constexpr std::size_t kLogHeaderBytes = 32;
constexpr std::size_t kLogSaltAt = 16;
constexpr std::size_t kFrameHeaderBytes = 24;
constexpr std::size_t kFrameSaltAt = 8;
constexpr std::size_t kSaltBytes = 8;

std::uint64_t SizeOf(const std::filesystem::path& file) {
  std::error_code missing;
  const auto size = std::filesystem::file_size(file, missing);
  return missing ? 0 : size;
}

template <std::size_t kBytes>
std::optional<std::array<std::uint8_t, kBytes>> ReadHead(std::ifstream& from,
                                                         std::uint64_t offset) {
  std::array<std::uint8_t, kBytes> bytes{};
  from.clear();
  from.seekg(static_cast<std::streamoff>(offset));
  from.read(reinterpret_cast<char*>(bytes.data()), kBytes);
  if (!from) return std::nullopt;
  return bytes;
}

}  // namespace

SqlitePages::SqlitePages(const std::filesystem::path& file)
    : file_(file, std::ios::binary), log_(file.string() + "-wal", std::ios::binary) {
  ReadHeader(SizeOf(file));
  ListFrames(SizeOf(file.string() + "-wal"));
}

void SqlitePages::ReadHeader(std::uint64_t file_bytes) {
  const auto bytes = ReadHead<SqliteHeader::kBytes>(file_, 0);
  const SqliteHeader header{bytes.value_or(std::array<std::uint8_t, SqliteHeader::kBytes>{})};
  std::uint32_t promised = 0;
  if (header.IsSqlite()) {
    is_store_ =
        header.application_id() == kApplicationId && header.user_version() == kSchemaVersion;
    const std::uint32_t size = header.page_bytes();
    if (size >= kLeastPage && (size & (size - 1)) == 0) page_bytes_ = size;
    const std::uint32_t reserved = header.reserved_bytes();
    usable_bytes_ = page_bytes_ >= kLeastUsable + reserved ? page_bytes_ - reserved : page_bytes_;
    promised = header.page_count();
    first_free_ = static_cast<PageNumber>(header.first_free_page());
  }
  const auto there = (file_bytes + page_bytes_ - 1) / page_bytes_;
  // A header may promise anything, so it is trusted for a file that was cut, but not for an empty
  // one.
  pages_ = static_cast<PageNumber>(std::min<std::uint64_t>(there, UINT32_MAX));
  if (promised > pages_ && promised / 1000 <= pages_) pages_ = promised;
}

// The log is written from its beginning again once the file has all of it, so that older frames are
// behind newer ones. The newer ones have the salt of its header.
void SqlitePages::ListFrames(std::uint64_t log_bytes) {
  const auto header = ReadHead<kLogHeaderBytes>(log_, 0);
  if (!header) return;
  const std::uint64_t frame_bytes = kFrameHeaderBytes + page_bytes_;
  std::vector<Frame> current;
  for (std::uint64_t at = kLogHeaderBytes; at + frame_bytes <= log_bytes; at += frame_bytes) {
    const auto frame = ReadHead<kFrameHeaderBytes>(log_, at);
    if (!frame) continue;
    const bool is_current =
        std::equal(frame->begin() + kFrameSaltAt, frame->begin() + kFrameSaltAt + kSaltBytes,
                   header->begin() + kLogSaltAt);
    (is_current ? current : frames_)
        .push_back({static_cast<PageNumber>(BigEndian(*frame, 0, 4)), at + kFrameHeaderBytes});
  }
  frames_.insert(frames_.end(), current.begin(), current.end());
  for (Moment moment = 1; moment <= frames_.size(); ++moment) {
    page_at_[PageAt(moment)].push_back(moment);
  }
}

// The rest of a cut file's last page counts, filled up with zeros.
std::optional<route::Bytes> SqlitePages::ReadAt(std::ifstream& from, std::uint64_t offset) const {
  route::Bytes page(page_bytes_);
  from.clear();
  from.seekg(static_cast<std::streamoff>(offset));
  from.read(reinterpret_cast<char*>(page.data()), page_bytes_);
  if (from.gcount() == 0 || from.bad()) return std::nullopt;
  page.resize(usable_bytes_);
  return page;
}

SqlitePages::Moment SqlitePages::LastChangeOf(PageNumber page) const {
  const auto changed = page_at_.find(page);
  return changed == page_at_.end() ? 0 : changed->second.back();
}

std::optional<route::Bytes> SqlitePages::Read(PageNumber page, Moment moment) {
  if (page == 0) return std::nullopt;
  if (const auto changed = page_at_.find(page); changed != page_at_.end()) {
    const auto after = std::upper_bound(changed->second.begin(), changed->second.end(), moment);
    if (after != changed->second.begin()) return ReadAt(log_, frames_[*(after - 1) - 1].offset);
  }
  return ReadAt(file_, std::uint64_t{page - 1} * page_bytes_);
}

}  // namespace trailcast::store
