#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace trailcast::mission {

// This decides which of several people teleoperates a robot, and how long a command of theirs is
// valid: it is a dead man's switch. It has no clock of its own.
class DriverSeat {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // A command is valid for this long from when it was given.
  static constexpr std::chrono::milliseconds kGoodFor{300};
  // A person who has been silent for this long no longer drives.
  static constexpr std::chrono::milliseconds kFreeAfter{1000};

  enum class Verdict { kGood, kLate, kTaken };
  // Takes a command. `said_ms` is when it was given, by the driver's own clock, whatever its epoch.
  [[nodiscard]] Verdict Hear(const std::string& driver, std::uint64_t said_ms, Time now);

  // Returns whether the last good command is still valid.
  [[nodiscard]] bool Holds(Time now) const { return now < good_until_; }
  // Returns whether somebody drives, or did a moment ago.
  [[nodiscard]] bool IsTaken(Time now) const { return now < free_at_; }
  // Returns how much later than usual the last command came.
  [[nodiscard]] std::chrono::milliseconds late() const { return late_; }

 private:
  void Sit(const std::string& driver, double delay_ms);

  std::string driver_;
  double least_delay_ms_ = 0.0;  // from the driver's clock to this: mostly their difference
  std::uint64_t last_said_ms_ = 0;
  Time last_heard_{};
  std::chrono::milliseconds late_{0};
  Time good_until_{};
  Time free_at_{};
};

}  // namespace trailcast::mission
