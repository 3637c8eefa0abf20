#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/base/time.h"

namespace trailcast::agent {

// Makes rising times from a sensor's stamps, which in practice step back or ahead (a clock that is
// set, a driver that is restarted), stand still, or are not set at all. Until such an event, the
// times are the stamps; after it, the time of arrival tells how much later a sample is. It reads no
// clock itself.
class StampClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Returns when the sample was taken, later than the one before, or nothing for a sample out of
  // order.
  [[nodiscard]] std::optional<SensorTime> Follow(SensorTime stamp, Time came_at);

  // Returns when the quickest sample since the last call came, less when it was taken: the
  // difference between this clock and the machine's, and the transmission. Nothing came if it is
  // empty.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> TakeBehind();
  // Says whether its stamps do not advance, so that the time of arrival counts.
  [[nodiscard]] bool stands() const { return stands_; }
  // Returns what happened to the stamps since the last call, for people, which may be empty.
  [[nodiscard]] std::string TakeNews();

 private:
  struct Sample {
    SensorTime stamp{};
    SensorTime taken{};
    Time came_at;
  };
  void NoteBehind();

  std::optional<Sample> last_;
  std::chrono::nanoseconds shift_{0};  // the returned times less the stamps
  bool stands_ = false;
  std::string news_;
  std::optional<std::chrono::nanoseconds> behind_;
};

}  // namespace trailcast::agent
