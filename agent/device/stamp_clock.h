#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "services/base/time.h"

namespace trailcast::agent {

// Makes times that go forward of a sensor's stamps, which in real life step back or ahead (a clock
// that is set, a driver that is started anew), stand still, or are not set at all. Until then they
// are the stamps themselves; afterwards the time of arrival says how much later a sample is. Reads
// no clock itself.
class StampClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // When the sample was taken, later than the one before; nothing for one that comes out of turn.
  [[nodiscard]] std::optional<SensorTime> Follow(SensorTime stamp, Time came_at);

  // When the quickest sample since the last call came, less when it was taken: where this clock
  // stands against the machine's, and how long its samples are under way. Nothing: none came.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> TakeBehind();
  // Its stamps do not go on: the time of arrival counts.
  [[nodiscard]] bool stands() const { return stands_; }
  // What befell the stamps since the last call, for people; empty: nothing.
  [[nodiscard]] std::string TakeNews();

 private:
  struct Sample {
    SensorTime stamp{};
    SensorTime taken{};
    Time came_at;
  };
  void NoteBehind();

  std::optional<Sample> last_;
  std::chrono::nanoseconds shift_{0};  // of what is told against the stamps
  bool stands_ = false;
  std::string news_;
  std::optional<std::chrono::nanoseconds> behind_;
};

}  // namespace trailcast::agent
