#include "services/program/output_file.h"

#include <unistd.h>

#include "services/base/durable_file.h"

namespace trailcast::program {

Result<void> CanBeWritten(const std::filesystem::path& file) {
  if (file.empty()) return {};
  if (access(FolderOf(file).c_str(), W_OK | X_OK) == 0) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot write {}: check that its folder exists and is writable", file.string());
}

}  // namespace trailcast::program
