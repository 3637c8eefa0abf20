#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace trailcast::dds {

// Chooses the publisher from which a topic is heard if there are several: the first one, until it
// is gone or silent. Two robots in one namespace, or a left-over driver, publish data that do not
// fit together. It reads no clock itself.
class Ros2Speaker {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // A publisher that is silent for longer is no longer waited for.
  static constexpr std::chrono::milliseconds kSilent{2000};
  // The publishers count as several for so long after both were heard.
  static constexpr std::chrono::milliseconds kTold{3000};

  // Says whether data from `writer` count. `there` tells whether another writer is still known to
  // exist.
  template <typename IsThere>
  [[nodiscard]] bool Hear(std::int64_t writer, Time now, const IsThere& there) {
    if (writer == heard_) {
      // A writer that takes over from another one does not alternate with it.
      if (other_at_ && *other_at_ > heard_at_) both_at_ = now;
    } else if (heard_at_ != Time() && now - heard_at_ <= kSilent && there(heard_)) {
      other_at_ = now;
      return false;
    }
    heard_ = writer;
    heard_at_ = now;
    return true;
  }
  // Says whether several publish at once.
  [[nodiscard]] bool crowded(Time now) const { return both_at_ && now - *both_at_ <= kTold; }

 private:
  std::int64_t heard_ = 0;
  Time heard_at_{};
  std::optional<Time> other_at_;
  std::optional<Time> both_at_;
};

}  // namespace trailcast::dds
