#include "services/program/output_file.h"

#include <unistd.h>

namespace trailcast::program {

Result<void> CanBeWritten(const std::filesystem::path& file) {
  if (file.empty()) return {};
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot write {}: check that its folder exists and is writable", file.string());
}

}  // namespace trailcast::program
