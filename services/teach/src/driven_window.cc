#include "services/teach/driven_window.h"

#include <algorithm>
#include <cmath>

namespace trailcast::teach {

std::optional<DrivenWindow::Spread> DrivenWindow::Measure() const {
  if (!of_segment_ || driven_s_ < kLeast_s) return std::nullopt;
  double mean = 0.0;
  for (const Sample& each : samples_) mean += each.value * each.dt_s / driven_s_;
  double squares = 0.0;
  for (const Sample& each : samples_) {
    squares += (each.value - mean) * (each.value - mean) * each.dt_s / driven_s_;
  }
  return Spread{mean, std::sqrt(std::max(0.0, squares))};
}

void DrivenWindow::Cut() {
  of_segment_ = false;
  while (!samples_.empty() && driven_s_ - samples_.front().dt_s >= kKept_s) {
    driven_s_ -= samples_.front().dt_s;
    samples_.pop_front();
  }
}

}  // namespace trailcast::teach
