#include "services/base/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace trailcast {
namespace {

std::error_code LastError() { return {errno, std::generic_category()}; }

std::error_code Sync(int descriptor) {
  // Some network file systems cannot synchronise folders and answer EINVAL.
  if (fsync(descriptor) == 0 || errno == EINVAL) return {};
  return LastError();
}

std::error_code WriteAll(int descriptor, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t more = write(descriptor, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR) return LastError();
    if (more > 0) written += static_cast<std::size_t>(more);
  }
  return Sync(descriptor);
}

std::error_code WriteFresh(const std::string& fresh, const std::string& text, mode_t mode) {
  unlink(fresh.c_str());
  const int descriptor = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) return LastError();
  const std::error_code error = WriteAll(descriptor, text);
  close(descriptor);
  return error;
}

// Fails with EFBIG if there are more than `most_bytes`.
std::error_code ReadAll(int descriptor, std::size_t most_bytes, std::string& text) {
  constexpr std::size_t kPart = 64U << 10U;
  for (ssize_t got = 1; got != 0;) {
    const std::size_t held = text.size();
    if (held > most_bytes) return std::make_error_code(std::errc::file_too_large);
    text.resize(held + std::min(kPart, most_bytes + 1 - held));
    got = read(descriptor, text.data() + held, text.size() - held);
    const std::error_code error = got < 0 ? LastError() : std::error_code();
    text.resize(held + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (error && error != std::errc::interrupted) return error;
  }
  return {};
}

}  // namespace

Result<std::string> ReadBoundedFile(const std::filesystem::path& file, std::size_t most_bytes) {
  // Nobody may ever write into a pipe.
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  std::error_code error = descriptor < 0 ? LastError() : std::error_code();
  struct stat about {};
  if (!error && fstat(descriptor, &about) != 0) error = LastError();
  const bool is_file = !error && S_ISREG(about.st_mode);
  std::string text;
  if (is_file) error = ReadAll(descriptor, most_bytes, text);
  if (descriptor >= 0) close(descriptor);
  if (is_file && !error) return text;
  if (!error || error == std::errc::file_too_large) {
    return Fail(ErrorCode::kCorrupt, "{} is no file, or larger than {} bytes", file.string(),
                most_bytes);
  }
  return Fail(error == std::errc::no_such_file_or_directory ? ErrorCode::kNotFound
                                                            : ErrorCode::kUnavailable,
              "cannot read {}: {}", file.string(), error.message());
}

Result<void> ReplaceFile(const std::filesystem::path& file, const std::string& text, mode_t mode) {
  // Several programs may write the same file, so each writes to a name of its own.
  const std::string fresh = fmt::format("{}.{}.new", file.string(), getpid());
  std::error_code error = WriteFresh(fresh, text, mode);
  if (!error && rename(fresh.c_str(), file.c_str()) != 0) error = LastError();
  if (error) {
    unlink(fresh.c_str());
  } else {
    error = SyncToDisk(FolderOf(file));
  }
  if (!error) return {};
  return Fail(ErrorCode::kUnavailable, "cannot write {}: {}", file.string(), error.message());
}

std::error_code SyncToDisk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return LastError();
  const std::error_code error = Sync(descriptor);
  close(descriptor);
  return error;
}

std::filesystem::path FolderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

}  // namespace trailcast
