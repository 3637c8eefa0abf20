#include "services/plot/plot_style.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trailcast::plot {

double TickStep(double length, double count) {
  const double raw = std::max(1e-9, length / count);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * power * 1.0001) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> Ticks(double from, double to, double step) {
  std::vector<double> ticks;
  const auto first = static_cast<std::int64_t>(std::ceil(from / step - 1e-9));
  const auto last = static_cast<std::int64_t>(std::floor(to / step + 1e-9));
  for (std::int64_t i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

}  // namespace trailcast::plot
