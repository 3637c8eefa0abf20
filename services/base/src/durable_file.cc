#include "services/base/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

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

}  // namespace

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
