#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace trailcast {

// The same trouble is told once, and again after a while. No clock.
class ToldLately {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMost = 1000;  // strangers can make up things to tell of

  explicit ToldLately(std::chrono::milliseconds again) : again_(again) {}

  // `what` is to be told now, and counts as told then.
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
