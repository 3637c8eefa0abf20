#include "services/security/src/files.h"

#include <fstream>
#include <system_error>

namespace trailcast::security {

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
