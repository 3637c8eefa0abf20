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

inline constexpr std::uint32_t kFileVersion = 2;
// Larger files are neither written nor read; this is enough for 300 km of route.
inline constexpr std::uint64_t kMaxFileBytes = 1ULL << 30U;

// A complete route in one file, open for reading. Open finds whatever is wrong with the file,
// because it reads and checks every byte and decodes every segment. It takes 48 bytes of memory a
// segment, and one segment at a time.
class RouteFile {
 public:
  // Opens a file. Anything but a whole route file is kCorrupt, which names the file, what was found
  // and what was expected; other errors are those of OpenFile.
  [[nodiscard]] static Result<RouteFile> Open(const std::filesystem::path& path);
  // Does the same with bytes in memory, which must outlive the result.
  [[nodiscard]] static Result<RouteFile> Open(std::span<const std::uint8_t> bytes);

  // The route is kComplete and within the bounds of what is accepted from a peer.
  [[nodiscard]] const route::RouteInfo& info() const { return info_; }
  [[nodiscard]] std::uint64_t file_bytes() const { return source_->size(); }
  // Returns its segments' digests, in order.
  [[nodiscard]] std::vector<route::Digest> digests() const;
  // Errors: kNotFound beyond the route's end, kCorrupt if the file was changed since it was opened.
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
