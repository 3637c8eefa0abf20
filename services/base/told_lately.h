#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace trailcast {

// Decides that the same trouble is reported once, and again only after a while. It reads no clock.
class ToldLately {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMost = 1000;  // strangers can make up things to report

  explicit ToldLately(std::chrono::milliseconds again) : again_(again) {}

  // Returns true if `what` is to be reported now, and then remembers it as reported.
  [[nodiscard]] bool IsDue(const std::string& what, Time now) {
    if (told_at_.size() >= kMost) told_at_.clear();
    const auto [at, is_first] = told_at_.try_emplace(what, now);
    if (!is_first && now < at->second + again_) return false;
    at->second = now;
    return true;
  }

 private:
  std::chrono::milliseconds again_;
  std::map<std::string, Time> told_at_;
};

}  // namespace trailcast
