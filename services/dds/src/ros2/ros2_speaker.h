#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace trailcast::dds {

// Whom a topic is heard from, of several who publish it: whoever was first, until it is gone or
// silent. Two robots in one namespace, or a driver that was left over, say what does not go
// together. Reads no clock itself.
class Ros2Speaker {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Who is silent for longer is no longer waited for.
  static constexpr std::chrono::milliseconds kSilent{2000};
  // So long after both were heard there are two.
  static constexpr std::chrono::milliseconds kTold{3000};

  // Whether what `writer` says counts; `there`: whether another one is still known to be there.
  template <typename IsThere>
  [[nodiscard]] bool Hear(std::int64_t writer, Time now, const IsThere& there) {
    if (writer == heard_) {
      // One that takes the place of another is not heard in between.
      if (other_at_ && *other_at_ > heard_at_) both_at_ = now;
    } else if (heard_at_ != Time() && now - heard_at_ <= kSilent && there(heard_)) {
      other_at_ = now;
      return false;
    }
    heard_ = writer;
    heard_at_ = now;
    return true;
  }
  // Several speak at once.
  [[nodiscard]] bool crowded(Time now) const { return both_at_ && now - *both_at_ <= kTold; }

 private:
  std::int64_t heard_ = 0;
  Time heard_at_{};
  std::optional<Time> other_at_;
  std::optional<Time> both_at_;
};

}  // namespace trailcast::dds
