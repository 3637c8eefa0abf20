#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "services/archive/byte_source.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::archive {

inline constexpr std::uint32_t kFileVersion = 1;
// Larger files are neither written nor read: 300 km of route.
inline constexpr std::uint64_t kMaxFileBytes = 1ULL << 30U;

// A complete route in one file, open for reading. Whatever is wrong with a file is found when it is
// opened: then every byte has been read and checked, every segment decoded. Memory: 48 bytes a
// segment, and one segment at a time.
class RouteFile {
 public:
  // kCorrupt, naming the file, what was found and what was expected, for anything but a whole route
  // file; else as OpenFile.
  [[nodiscard]] static Result<RouteFile> Open(const std::filesystem::path& path);
  // The same of bytes in memory, which outlive what is returned.
  [[nodiscard]] static Result<RouteFile> Open(std::span<const std::uint8_t> bytes);

  // kComplete, within the bounds of what is accepted from a peer.
  [[nodiscard]] const route::RouteInfo& info() const { return info_; }
  [[nodiscard]] std::uint64_t file_bytes() const { return source_->size(); }
  // Of its segments, in order.
  [[nodiscard]] std::vector<route::Digest> digests() const;
  // kNotFound beyond the route's end; kCorrupt if the file was changed since it was opened.
  [[nodiscard]] Result<route::SegmentPiece> ReadSegment(SegmentIndex index) const;

 private:
  friend class RouteFileChecker;
  struct Entry {
    std::uint64_t offset = 0;  // of the segment's bytes
    std::uint32_t size = 0;
    route::Digest digest{};
  };

  explicit RouteFile(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {}
  [[nodiscard]] static Result<RouteFile> Check(std::unique_ptr<ByteSource> source);

  std::unique_ptr<ByteSource> source_;
  route::RouteInfo info_;
  std::vector<Entry> segments_;
};

}  // namespace trailcast::archive
