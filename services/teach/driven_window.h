#pragma once

#include <deque>
#include <optional>

namespace trailcast::teach {

// This computes mean and spread of a value over the time that a robot drove in a segment. As short
// segments tell little, it includes so much of what was driven before that there is a second of it.
class DrivenWindow {
 public:
  // Adds a value that held for `dt_s`.
  void Add(double value, double dt_s) {
    samples_.push_back({value, dt_s});
    driven_s_ += dt_s;
    of_segment_ = true;
  }

  struct Spread {
    double mean = 0.0;
    double deviation = 0.0;  // RMS about the mean
  };
  // Returns nothing if nothing was added in this segment, or less than kLeast_s altogether.
  [[nodiscard]] std::optional<Spread> Measure() const;
  // Ends the segment.
  void Cut();

 private:
  static constexpr double kLeast_s = 0.5;
  static constexpr double kKept_s = 1.0;

  struct Sample {
    double value = 0.0;
    double dt_s = 0.0;
  };
  std::deque<Sample> samples_;
  double driven_s_ = 0.0;
  bool of_segment_ = false;
};

}  // namespace trailcast::teach
