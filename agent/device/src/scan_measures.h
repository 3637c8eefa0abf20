#pragma once

#include <chrono>

#include "agent/device/robot_measures.h"
#include "services/motion/scan.h"

namespace trailcast::agent {

// Measures a scanner's or a range sensor's samples as they come.
class Coming {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void Note(Time now) {
    if (count_++ == 0) first_ = now;
    last_ = now;
  }
  [[nodiscard]] int count() const { return count_; }
  // Returns how many come a second.
  [[nodiscard]] double rate_hz() const;

 private:
  int count_ = 0;
  Time first_{};
  Time last_{};
};

}  // namespace trailcast::agent
