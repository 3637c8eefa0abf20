#include "services/security/src/files.h"

#include <system_error>

#include "services/base/durable_file.h"

namespace trailcast::security {

Result<std::string> ReadSmallFile(const std::filesystem::path& file) {
  constexpr std::size_t kMostBytes = 4U << 20U;
  return ReadBoundedFile(file, kMostBytes);
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
