#include "services/archive/route_file_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <random>
#include <system_error>
#include <tuple>
#include <utility>

#include "services/archive/route_file.h"
#include "services/archive/src/layout.h"
#include "services/base/durable_file.h"
#include "services/route/bounds.h"
#include "services/route/info_codec.h"

namespace trailcast::archive {
namespace {

namespace fs = std::filesystem;

Result<void> CheckExportable(const route::RouteInfo& info) {
  if (info.state != route::RouteState::kComplete) {
    return Fail(ErrorCode::kInvalidArgument,
                "route '{}' revision {} is still being taught ({} segments so far), and only "
                "complete routes are exported",
                info.name, info.revision.value(), info.segment_count);
  }
  return route::CheckInfo(info);
}

std::uint64_t FileBytes(const route::RouteInfo& info, std::size_t info_bytes) {
  return kPreambleBytes + info_bytes + info.segment_count * std::uint64_t{kFrameBytes} +
         info.bytes + kChecksumBytes;
}

tl::unexpected<Error> IsThere(const fs::path& path) {
  return Fail(ErrorCode::kConflict,
              "{} is there already; give another file with --out, or replace it with --force",
              path.string());
}

Result<void> CheckPlace(const fs::path& path, RouteFileWriter::Existing existing) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status)) return {};
  if (!fs::is_regular_file(status)) {
    return Fail(ErrorCode::kConflict, "{} is a folder or a device and cannot be replaced by a file",
                path.string());
  }
  if (existing == RouteFileWriter::Existing::kKeep) return IsThere(path);
  return {};
}

}  // namespace

Result<RouteFileWriter> RouteFileWriter::Create(fs::path path, const route::RouteInfo& info,
                                                Existing existing) {
  if (auto possible = CheckExportable(info); !possible) return tl::unexpected(possible.error());
  if (auto free = CheckPlace(path, existing); !free) return tl::unexpected(free.error());
  std::random_device random;
  fs::path part = fmt::format("{}.{:08x}.part", path.string(), random());
  RouteFileWriter writer(std::move(path), std::move(part), info, existing);
  if (auto begun = writer.Begin(); !begun) return tl::unexpected(begun.error());
  return writer;
}

RouteFileWriter::RouteFileWriter(fs::path path, fs::path part, route::RouteInfo info,
                                 Existing existing)
    : path_(std::move(path)), part_(std::move(part)), info_(std::move(info)), existing_(existing) {}

RouteFileWriter::RouteFileWriter(RouteFileWriter&& other) noexcept
    : path_(std::move(other.path_)),
      part_(std::exchange(other.part_, {})),
      info_(std::move(other.info_)),
      existing_(other.existing_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      added_(other.added_),
      written_(other.written_),
      hash_(std::move(other.hash_)) {}

RouteFileWriter::~RouteFileWriter() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!part_.empty()) unlink(part_.c_str());
}

tl::unexpected<Error> RouteFileWriter::CannotWrite(int error) const {
  return Fail(ErrorCode::kUnavailable,
              "cannot write {}: {}; its folder must exist and have room for {} bytes",
              path_.string(), std::generic_category().message(error), info_.bytes);
}

Result<void> RouteFileWriter::Begin() {
  const route::Bytes description = route::EncodeInfo(AsTaught(info_));
  const std::uint64_t size = FileBytes(info_, description.size());
  if (info_.bytes > kMaxFileBytes || size > kMaxFileBytes) {
    part_.clear();
    return Fail(ErrorCode::kInvalidArgument,
                "route '{}' has {} bytes, too many for a file of at most {}", info_.name,
                info_.bytes, kMaxFileBytes);
  }
  descriptor_ = open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    part_.clear();
    return CannotWrite(error);
  }
  route::Bytes bytes(kMagic.begin(), kMagic.end());
  AppendNumber(bytes, kFileVersion, 4);
  AppendNumber(bytes, description.size(), 4);
  AppendNumber(bytes, size, 8);
  bytes.insert(bytes.end(), description.begin(), description.end());
  return Write(bytes);
}

Result<void> RouteFileWriter::Add(const route::SegmentPiece& piece) {
  if (piece.key != info_.key || piece.index.value() != added_) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}: segment {} of route {} is not the next, which is {} of {}", path_.string(),
                piece.index.value(), piece.key.route.value(), added_, info_.key.route.value());
  }
  if (auto intact = route::CheckDigest(piece); !intact) return intact;
  route::Bytes bytes;
  bytes.reserve(kFrameBytes + piece.bytes.size());
  AppendNumber(bytes, added_, 4);
  AppendNumber(bytes, piece.bytes.size(), 4);
  bytes.insert(bytes.end(), piece.digest.begin(), piece.digest.end());
  bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
  if (auto written = Write(bytes); !written) return written;
  ++added_;
  return {};
}

Result<std::uint64_t> RouteFileWriter::Finish() {
  const route::Digest checksum = hash_.Finish();
  hash_ = {};  // the checksum does not cover itself
  if (auto written = Write(checksum); !written) return tl::unexpected(written.error());
  if (auto closed = Close(); !closed) return tl::unexpected(closed.error());
  // A file that nobody could import is not kept.
  if (const auto whole = RouteFile::Open(part_); !whole) {
    return Wrap(whole.error(), "route '" + info_.name + "' is not as its description says");
  }
  if (auto named = TakeName(); !named) return tl::unexpected(named.error());
  return written_;
}

Result<void> RouteFileWriter::Write(std::span<const std::uint8_t> bytes) {
  hash_.Add(bytes);
  written_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return CannotWrite(errno);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return {};
}

Result<void> RouteFileWriter::Close() {
  if (fsync(descriptor_) != 0) return CannotWrite(errno);
  // Some file systems report only here that the disk is full.
  if (close(std::exchange(descriptor_, -1)) != 0) return CannotWrite(errno);
  return {};
}

Result<void> RouteFileWriter::TakeName() {
  const unsigned flags = existing_ == Existing::kKeep ? RENAME_NOREPLACE : 0U;
  int status = renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, path_.c_str(), flags);
  if (status != 0 && (errno == EINVAL || errno == ENOSYS)) {
    // Some file systems cannot do this in one step, so the place is checked once more instead.
    if (auto free = CheckPlace(path_, existing_); !free) return free;
    status = std::rename(part_.c_str(), path_.c_str());
  }
  if (status != 0 && errno == EEXIST) return IsThere(path_);
  if (status != 0) return CannotWrite(errno);
  part_.clear();
  // This makes the name outlast a loss of power, too. Where folders cannot be synchronised, the
  // file's contents still do.
  std::ignore = SyncToDisk(FolderOf(path_));
  return {};
}

}  // namespace trailcast::archive
