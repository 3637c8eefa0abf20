#pragma once

#include <filesystem>

namespace trailcast::soak {

// A small file system of its own in memory, which can be filled without harm. This process alone
// and its children see it, and it goes with them. Needs root.
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
