#pragma once

#include <filesystem>

namespace trailcast::soak {

// This is a small file system in memory, which can be filled without harm. Only this process and
// its children see it, and it disappears with them. It needs root.
class PrivateDisk {
 public:
  static constexpr int kMegabytes = 64;
  explicit PrivateDisk(std::filesystem::path folder);
  ~PrivateDisk();
  PrivateDisk(const PrivateDisk&) = delete;
  PrivateDisk& operator=(const PrivateDisk&) = delete;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace trailcast::soak
