#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"

namespace trailcast {

// A fresh folder under the system's temporary one. The destructor removes it with its contents
// unless it is to be kept.
class WorkFolder {
 public:
  [[nodiscard]] static Result<WorkFolder> Make();
  WorkFolder(WorkFolder&& other) noexcept;
  WorkFolder& operator=(WorkFolder&& other) noexcept;
  ~WorkFolder();

  void Keep() { keep_ = true; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }

 private:
  explicit WorkFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;  // empty after a move
  bool keep_ = false;
};

}  // namespace trailcast
