#include "services/archive/route_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/archive/src/layout.h"
#include "services/base/hex.h"
#include "services/route/codec.h"
#include "services/route/digest.h"
#include "services/route/info_codec.h"

namespace trailcast::archive {

// Reads a file from its beginning to its end without trusting any of it. The checksum finds damage;
// the other checks find files that were made to deceive.
class RouteFileChecker {
 public:
  explicit RouteFileChecker(RouteFile& file) : file_(file), source_(*file.source_) {}

  Result<void> Check() {
    if (auto ok = CheckPreamble(); !ok) return ok;
    if (auto ok = CheckChecksum(); !ok) return ok;
    if (auto ok = ReadInfo(); !ok) return ok;
    for (std::uint32_t i = 0; i < file_.info_.segment_count; ++i) {
      if (auto ok = ReadFrame(SegmentIndex(i)); !ok) return ok;
    }
    return CheckSums();
  }

 private:
  template <typename... Args>
  tl::unexpected<Error> Refuse(fmt::format_string<Args...> format, Args&&... args) const {
    return Fail(ErrorCode::kCorrupt, "{}: {}", source_.name(),
                fmt::format(format, std::forward<Args>(args)...));
  }

  Result<void> CheckPreamble() {
    const std::uint64_t size = source_.size();
    if (size > kMaxFileBytes) {
      return Refuse("it has {} bytes, a route file at most {}", size, kMaxFileBytes);
    }
    std::array<std::uint8_t, kPreambleBytes> preamble{};
    const std::span<std::uint8_t> there(preamble.data(),
                                        std::min<std::uint64_t>(size, preamble.size()));
    if (auto read = source_.Read(0, there); !read) return read;
    const std::span<const std::uint8_t> magic = there.first(std::min(there.size(), kMagic.size()));
    if (!std::equal(magic.begin(), magic.end(), kMagic.begin(), kMagic.end())) {
      return Refuse("it is no route file: it begins with [{:02x}], expected [{:02x}] (\"{}\")",
                    fmt::join(magic, " "), fmt::join(kMagic, " "), kMagic);
    }
    if (there.size() < preamble.size()) {
      return Refuse("it is cut short: {} bytes, expected {} or more; copy it again", size,
                    preamble.size());
    }
    return CheckSizes(preamble);
  }

  Result<void> CheckSizes(std::span<const std::uint8_t> preamble) {
    if (const auto version = NumberAt(preamble, kVersionAt, 4); version != kFileVersion) {
      return Refuse("it is a route file of version {}, this program reads {} alone: {}", version,
                    kFileVersion, version > kFileVersion ? "update it" : "teach the route again");
    }
    const std::uint64_t promised = NumberAt(preamble, kFileSizeAt, 8);
    if (source_.size() < promised) {
      return Refuse("it is cut short: {} bytes, expected {}; copy it again", source_.size(),
                    promised);
    }
    if (source_.size() > promised) {
      return Refuse("it goes on after its end: {} bytes, expected {}; copy it again",
                    source_.size(), promised);
    }
    info_bytes_ = NumberAt(preamble, kInfoSizeAt, 4);
    if (info_bytes_ == 0 || info_bytes_ > route::kMaxInfoBytes) {
      return Refuse("its description of the route has {} bytes, expected 1 to {}", info_bytes_,
                    route::kMaxInfoBytes);
    }
    if (promised < kPreambleBytes + info_bytes_ + kChecksumBytes) {
      return Refuse("it has {} bytes, too few for the {} of its description", promised,
                    info_bytes_);
    }
    end_ = promised - kChecksumBytes;
    return {};
  }

  Result<void> CheckChecksum() {
    route::Sha256Stream hash;
    std::array<std::uint8_t, 64U << 10U> chunk{};
    for (std::uint64_t at = 0; at < end_; at += chunk.size()) {
      const std::span<std::uint8_t> part(chunk.data(),
                                         std::min<std::uint64_t>(end_ - at, chunk.size()));
      if (auto read = source_.Read(at, part); !read) return read;
      hash.Add(part);
    }
    route::Digest expected{};
    if (auto read = source_.Read(end_, expected); !read) return read;
    const route::Digest actual = hash.Finish();
    if (actual == expected) return {};
    return Refuse(
        "it is damaged: its bytes have checksum {:.12}.., expected {:.12}..; copy it again",
        ToHex(actual), ToHex(expected));
  }

  Result<void> ReadInfo() {
    route::Bytes bytes(info_bytes_);
    if (auto read = source_.Read(kPreambleBytes, bytes); !read) return read;
    auto info = route::DecodeInfo(bytes);
    if (!info) return Wrap(info.error(), source_.name());
    if (info->state != route::RouteState::kComplete) {
      return Refuse("its route is still being taught, expected a complete one");
    }
    at_ = kPreambleBytes + info_bytes_;
    const std::uint64_t room = (end_ - at_) / (kFrameBytes + 1);
    if (info->segment_count == 0 || info->segment_count > room) {
      return Refuse("it says that it has {} segments, expected 1 to the {} for which it has room",
                    info->segment_count, room);
    }
    file_.info_ = AsTaught(std::move(*info));
    return {};
  }

  Result<void> ReadFrame(SegmentIndex index) {
    std::array<std::uint8_t, kFrameBytes> frame{};
    if (end_ - at_ < frame.size()) {
      return Refuse("segment {} is missing: {} bytes are left, expected {} or more", index.value(),
                    end_ - at_, frame.size() + 1);
    }
    if (auto read = source_.Read(at_, frame); !read) return read;
    at_ += frame.size();
    if (const auto found = NumberAt(frame, 0, 4); found != index.value()) {
      return Refuse("its segments are out of order: found segment {}, expected {}", found,
                    index.value());
    }
    const std::uint64_t size = NumberAt(frame, 4, 4);
    const std::uint64_t most = std::min<std::uint64_t>(end_ - at_, route::kMaxSegmentBytes);
    if (size == 0 || size > most) {
      return Refuse("segment {} has {} bytes, expected 1 to {}", index.value(), size, most);
    }
    RouteFile::Entry entry{.offset = at_, .size = static_cast<std::uint32_t>(size), .digest = {}};
    std::copy_n(frame.begin() + kFrameDigestAt, entry.digest.size(), entry.digest.begin());
    file_.segments_.push_back(entry);
    at_ += size;
    return OpenSegment(index);
  }

  Result<void> OpenSegment(SegmentIndex index) const {
    const auto piece = file_.ReadSegment(index);
    if (!piece) return tl::unexpected(piece.error());
    if (const auto segment = route::Open(*piece); !segment) {
      return Wrap(segment.error(), source_.name());
    }
    return {};
  }

  Result<void> CheckSums() const {
    if (at_ != end_) {
      return Refuse("{} bytes follow its last segment, expected none", end_ - at_);
    }
    std::vector<route::Digest> digests;
    std::uint64_t bytes = 0;
    for (const RouteFile::Entry& entry : file_.segments_) {
      digests.push_back(entry.digest);
      bytes += entry.size;
    }
    if (bytes != file_.info_.bytes) {
      return Refuse("its segments have {} bytes together, expected {}", bytes, file_.info_.bytes);
    }
    const route::Digest manifest = route::ManifestDigest(digests);
    if (manifest == file_.info_.manifest_digest) return {};
    return Refuse("its segments are not those of its manifest: digest {:.12}.., expected {:.12}..",
                  ToHex(manifest), ToHex(file_.info_.manifest_digest));
  }

  RouteFile& file_;
  const ByteSource& source_;
  std::uint64_t info_bytes_ = 0;
  std::uint64_t at_ = 0;   // everything before this is read
  std::uint64_t end_ = 0;  // end of the segments; the checksum follows
};

Result<RouteFile> RouteFile::Check(std::unique_ptr<ByteSource> source) {
  RouteFile file(std::move(source));
  if (auto whole = RouteFileChecker(file).Check(); !whole) return tl::unexpected(whole.error());
  return file;
}

Result<RouteFile> RouteFile::Open(const std::filesystem::path& path) {
  auto source = OpenFile(path);
  if (!source) return tl::unexpected(source.error());
  return Check(std::move(*source));
}

Result<RouteFile> RouteFile::Open(std::span<const std::uint8_t> bytes) {
  return Check(FromMemory(bytes));
}

std::vector<route::Digest> RouteFile::digests() const {
  std::vector<route::Digest> digests;
  for (const Entry& entry : segments_) digests.push_back(entry.digest);
  return digests;
}

Result<route::SegmentPiece> RouteFile::ReadSegment(SegmentIndex index) const {
  if (index.value() >= segments_.size()) {
    return Fail(ErrorCode::kNotFound, "{} has {} segments, and no segment {}", source_->name(),
                segments_.size(), index.value());
  }
  const Entry& entry = segments_[index.value()];
  route::SegmentPiece piece{info_.key, index, entry.digest, route::Bytes(entry.size)};
  if (auto read = source_->Read(entry.offset, piece.bytes); !read) {
    return tl::unexpected(read.error());
  }
  if (auto intact = route::CheckDigest(piece); !intact) {
    return Wrap(intact.error(), source_->name());
  }
  return piece;
}

}  // namespace trailcast::archive
