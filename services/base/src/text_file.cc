#include "services/base/text_file.h"

#include <fstream>

namespace trailcast {

Result<void> WriteTextFile(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) {
    return Fail(ErrorCode::kUnavailable,
                "cannot write {}: does its folder exist, and is there room on the disk?",
                file.string());
  }
  return {};
}

}  // namespace trailcast
