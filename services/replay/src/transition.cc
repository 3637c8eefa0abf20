#include "services/replay/transition.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trailcast::replay {
namespace {

double Exponent(double squared_error, double sigma) {
  return sigma > 0.0 ? squared_error / (2.0 * sigma * sigma) : 0.0;
}

}  // namespace

double EndProbability(const TransitionErrors& errors) {
  return std::exp(-Exponent(errors.feature_px2, errors.feature_sigma_px)) *
         std::exp(-Exponent(errors.distance_m2, errors.distance_sigma_m)) *
         std::exp(-Exponent(errors.heading_rad2, errors.heading_sigma_rad));
}

double MedianFilter::Add(double value) {
  window_.push_back(value);
  if (window_.size() > length_) window_.pop_front();
  std::vector<double> sorted(window_.begin(), window_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

TransitionDetector::TransitionDetector(const TransitionOptions& options)
    : options_(options),
      current_{MedianFilter(options.median_length)},
      previous_{MedianFilter(options.median_length)} {}

bool TransitionDetector::Add(double delta, double delta_minus) {
  current_.value = current_.filter.Add(delta);
  previous_.value = previous_.filter.Add(delta_minus);
  current_.peak = std::max(current_.peak, current_.value);
  previous_.peak = std::max(previous_.peak, previous_.value);
  return current_.peak - current_.value > options_.tau &&
         previous_.peak - previous_.value > options_.tau;
}

}  // namespace trailcast::replay
