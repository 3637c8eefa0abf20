#pragma once

#include <cstddef>
#include <deque>

namespace trailcast::replay {

// This is equation (2) of Chen & Birchfield 2009, which tells whether the segment's end is reached.

// These are squared errors, and the scales that make them comparable. A term whose sigma is zero is
// left out (no odometry; no feature).
struct TransitionErrors {
  double feature_px2 = 0.0;       // e_f: mean squared distance to the milestone's features, along x
  double feature_sigma_px = 0.0;  // sigma_f: root of the same at the segment's start
  double distance_m2 = 0.0;       // e_l: squared difference of distance driven and length
  double distance_sigma_m = 0.0;  // sigma_l: the segment's length
  double heading_rad2 = 0.0;      // e_h: squared difference to the segment's final heading
  double heading_sigma_rad = 0.0;  // sigma_h: the largest heading variation in the segment
};

// Returns delta, in [0, 1].
[[nodiscard]] double EndProbability(const TransitionErrors& errors);

// This is the median of the last `length` values, the nonlinear low-pass filter.
class MedianFilter {
 public:
  explicit MedianFilter(std::size_t length) : length_(length) {}
  [[nodiscard]] double Add(double value);

 private:
  std::size_t length_;
  std::deque<double> window_;
};

struct TransitionOptions {
  double tau = 0.05;              // the paper's figure
  std::size_t median_length = 5;  // frames; at 30 Hz shorter than any segment
};

// This watches delta (against this segment's milestone) and delta minus (against the previous one),
// and tells when both have fallen by more than tau from their highest.
class TransitionDetector {
 public:
  explicit TransitionDetector(const TransitionOptions& options = {});

  // Returns true if the segment's end has been passed.
  [[nodiscard]] bool Add(double delta, double delta_minus);

  // These are smoothed, as of the last Add.
  [[nodiscard]] double delta() const { return current_.value; }
  [[nodiscard]] double delta_minus() const { return previous_.value; }
  // Tells that delta is at its highest so far, which is the best guess yet of where the milestone
  // is.
  [[nodiscard]] bool at_peak() const { return current_.value >= current_.peak; }

 private:
  struct Signal {
    MedianFilter filter;
    double value = 0.0;
    double peak = 0.0;
  };

  TransitionOptions options_;
  Signal current_;
  Signal previous_;
};

}  // namespace trailcast::replay
