#include "services/security/src/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace trailcast::security {
namespace {

std::string Reason() { return std::generic_category().message(errno); }

bool WriteAll(int file, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t more = write(file, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR) return false;
    if (more > 0) written += static_cast<std::size_t>(more);
  }
  return fsync(file) == 0;
}

}  // namespace

Result<std::string> ReadSmallFile(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = 4U << 20U;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) {
    const bool missing = error == std::errc::no_such_file_or_directory;
    return Fail(missing ? ErrorCode::kNotFound : ErrorCode::kUnavailable, "{}: {}", file.string(),
                error.message());
  }
  if (bytes > kMostBytes) {
    return Fail(ErrorCode::kInvalidArgument, "{}: {} bytes are too many for what it should be",
                file.string(), bytes);
  }
  std::ifstream in(file, std::ios::binary);
  std::string text(bytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (!in.is_open() || in.bad()) {
    return Fail(ErrorCode::kUnavailable, "{}: cannot be read by this user", file.string());
  }
  return text;
}

Result<void> WriteFile(const std::filesystem::path& file, const std::string& text, mode_t mode) {
  // Several programs may run with one folder: each writes under a name of its own.
  const std::string fresh = fmt::format("{}.{}.new", file.string(), getpid());
  unlink(fresh.c_str());
  const int out = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (out < 0) return Fail(ErrorCode::kUnavailable, "cannot write {}: {}", fresh, Reason());
  const bool written = WriteAll(out, text);
  const std::string reason = Reason();
  close(out);
  if (written && rename(fresh.c_str(), file.c_str()) == 0) return {};
  const std::string why = written ? Reason() : reason;
  unlink(fresh.c_str());
  return Fail(ErrorCode::kUnavailable, "cannot write {}: {}", file.string(), why);
}

Result<void> MakePrivateFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) {
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, error);
  }
  if (error) {
    return Fail(ErrorCode::kUnavailable, "cannot make folder {}: {}", folder.string(),
                error.message());
  }
  return {};
}

}  // namespace trailcast::security
