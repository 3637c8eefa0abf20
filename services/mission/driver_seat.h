#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace trailcast::mission {

// Which of several people drives a robot by hand, and how long a word of theirs is good for: a dead
// man's switch. No clock of its own.
class DriverSeat {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // From when it was said.
  static constexpr std::chrono::milliseconds kGoodFor{300};
  // Who has been silent for so long no longer drives.
  static constexpr std::chrono::milliseconds kFreeAfter{1000};

  enum class Verdict { kGood, kLate, kTaken };
  // `said_ms`: by the driver's own clock, whatever that begins with.
  [[nodiscard]] Verdict Hear(const std::string& driver, std::uint64_t said_ms, Time now);

  // Whether the last good word still is.
  [[nodiscard]] bool Holds(Time now) const { return now < good_until_; }
  // Whether somebody drives, or did a moment ago.
  [[nodiscard]] bool IsTaken(Time now) const { return now < free_at_; }
  // By how much later than usual the last word came.
  [[nodiscard]] std::chrono::milliseconds late() const { return late_; }

 private:
  void Sit(const std::string& driver, double delay_ms);

  std::string driver_;
  double least_delay_ms_ = 0.0;  // from the driver's clock to here: mostly how the clocks differ
  std::uint64_t last_said_ms_ = 0;
  Time last_heard_{};
  std::chrono::milliseconds late_{0};
  Time good_until_{};
  Time free_at_{};
};

}  // namespace trailcast::mission
