#include "services/base/work_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace trailcast {

Result<WorkFolder> WorkFolder::Make() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string pattern = ((error ? "/tmp" : parent) / "trailcast-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    return Fail(ErrorCode::kUnavailable, "cannot make a temporary folder {}: {}", pattern,
                std::generic_category().message(errno));
  }
  return WorkFolder(pattern);
}

WorkFolder::WorkFolder(WorkFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), keep_(other.keep_) {}

WorkFolder& WorkFolder::operator=(WorkFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(keep_, other.keep_);
  return *this;
}

WorkFolder::~WorkFolder() {
  if (path_.empty() || keep_) return;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace trailcast
