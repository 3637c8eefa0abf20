#include "services/store/store_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "services/base/durable_file.h"
#include "services/store/src/salvage/replacement.h"
#include "services/store/src/salvage/sqlite_header.h"

namespace trailcast::store {
namespace {

constexpr int kAttempts = 10;
std::string Reason(int error) { return std::generic_category().message(error); }

bool HasContent(const std::filesystem::path& path) {
  std::error_code missing;
  return std::filesystem::file_size(path, missing) > 0 && !missing;
}

// Returns how many bytes the header promises, or 0 if its count cannot be relied on.
std::uint64_t PromisedBytes(const SqliteHeader& header) {
  if (!header.page_count_is_current()) return 0;
  return std::uint64_t{header.page_count()} * header.page_bytes();
}

}  // namespace

Result<StoreFile> StoreFile::Acquire(const std::filesystem::path& path, Condition condition) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return Fail(ErrorCode::kCorrupt, "{} is no file (a folder or a device), expected a route store",
                path.string());
  }
  // Another file may be put in its place before it is locked.
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Result<StoreFile> file = OpenLocked(path);
    if (!file) return file;
    if (!file->IsStillThere()) continue;
    if (const Replacement replacement(path); replacement.IsBegun()) {
      if (auto finished = replacement.Finish(); !finished) return tl::unexpected(finished.error());
      continue;
    }
    if (condition == Condition::kDamaged) return file;
    if (Result<void> fit = file->Inspect(); !fit) return tl::unexpected(fit.error());
    return file;
  }
  return Fail(ErrorCode::kConflict, "route store {} is being replaced by another process",
              path.string());
}

Result<StoreFile> StoreFile::OpenLocked(const std::filesystem::path& path) {
  std::error_code unknown;
  const bool is_new = !std::filesystem::exists(path, unknown);
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    const int error = errno;
    const bool there = HasContent(path);
    return Fail(ErrorCode::kUnavailable, "cannot open route store {}: {}; {}", path.string(),
                Reason(error),
                there ? "copy it, and the file of its name with -wal behind where there is one, "
                        "into a folder that can be written, and give the copy"
                      : "its folder must exist, and be writable");
  }
  StoreFile file(path, descriptor);
  if (Result<void> locked = file.Lock(); !locked) return tl::unexpected(locked.error());
  // SQLite waits until a file's contents are on the disk, but not for the file's name.
  if (const std::error_code failed = is_new ? SyncToDisk(FolderOf(path)) : std::error_code();
      failed) {
    return Fail(ErrorCode::kUnavailable, "cannot write the folder of route store {}: {}",
                path.string(), failed.message());
  }
  return file;
}

bool StoreFile::IsStillThere() const {
  struct stat locked {};
  struct stat named {};
  return fstat(descriptor_, &locked) == 0 && stat(path_.c_str(), &named) == 0 &&
         locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

// It is closed after SQLite's own descriptors, because closing any of them drops SQLite's record
// locks.
StoreFile::~StoreFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

Result<void> StoreFile::Lock() const {
  int status = 0;
  do {
    status = flock(descriptor_, LOCK_EX | LOCK_NB);
  } while (status != 0 && errno == EINTR);
  if (status == 0) return {};
  const int error = errno;
  if (error == EWOULDBLOCK) {
    return Fail(ErrorCode::kConflict,
                "route store {} is open in another process; stop that one, or give this one a file "
                "of its own",
                path_.string());
  }
  return Fail(ErrorCode::kUnavailable, "cannot lock route store {}: {}", path_.string(),
              Reason(error));
}

Result<void> StoreFile::Inspect() const {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) {
    return Fail(ErrorCode::kUnavailable, "cannot read {}: {}", path_.string(), Reason(errno));
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) return {};  // it is new, or its making was interrupted
  SqliteHeader header;
  const ssize_t read = pread(descriptor_, header.bytes.data(), SqliteHeader::kBytes, 0);
  // Its making was cut off, before or after its first page; SQLite undoes it by the journal.
  const bool is_being_made = HasContent(path_.string() + "-journal");
  const bool is_blank = std::all_of(header.bytes.begin(), header.bytes.end(),
                                    [](std::uint8_t byte) { return byte == 0; });
  if (is_being_made && is_blank) return {};
  if (read != static_cast<ssize_t>(SqliteHeader::kBytes) || !header.IsSqlite() ||
      header.application_id() != kApplicationId) {
    return Fail(ErrorCode::kCorrupt,
                "{} is not a route store; it was left untouched, give another file",
                path_.string());
  }
  const std::uint32_t version = header.user_version();
  if (version != kSchemaVersion) {
    return Fail(ErrorCode::kCorrupt,
                "route store {} has version {}, this program reads {}; teach its routes again, "
                "into another file, or go on with the program that wrote it",
                path_.string(), version, kSchemaVersion);
  }
  // With a log beside it, the file may rightly be shorter; SQLite decides when it recovers.
  const bool has_log = is_being_made || HasContent(path_.string() + "-wal");
  if (size < PromisedBytes(header) && !has_log) {
    return Fail(ErrorCode::kCorrupt,
                "route store {} is cut short: {} bytes, expected {}; restore a copy, or move it "
                "away to begin a new one",
                path_.string(), size, PromisedBytes(header));
  }
  return {};
}

}  // namespace trailcast::store
