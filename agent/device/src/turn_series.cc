#include "agent/device/src/turn_series.h"

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kLongestLag_s = 0.5;
constexpr double kLagStep_s = 0.01;
constexpr double kPeriod_s = 0.1;  // over which a change is taken
constexpr double kClear = 0.8;     // correlation
constexpr std::size_t kFewest = 10;

}  // namespace

double ValueAt(const std::vector<TimedValue>& series, double t_s) {
  const auto after =
      std::lower_bound(series.begin(), series.end(), t_s,
                       [](const TimedValue& each, double time_s) { return each.t_s < time_s; });
  if (after == series.begin()) return series.front().value;
  if (after == series.end()) return series.back().value;
  const TimedValue& before = *std::prev(after);
  const double share = (t_s - before.t_s) / (after->t_s - before.t_s);
  return std::lerp(before.value, after->value, share);
}

std::optional<double> LagOf(const std::vector<TimedValue>& series,
                            const std::vector<TimedValue>& reference) {
  if (series.size() < kFewest || reference.size() < kFewest) return std::nullopt;
  double best = 0.0;
  double best_lag_s = 0.0;
  for (double lag_s = -kLongestLag_s; lag_s <= kLongestLag_s; lag_s += kLagStep_s) {
    double both = 0.0;
    double one = 0.0;
    double other = 0.0;
    for (const TimedValue& each : series) {
      const double a = each.value - ValueAt(series, each.t_s - kPeriod_s);
      const double b =
          ValueAt(reference, each.t_s - lag_s) - ValueAt(reference, each.t_s - lag_s - kPeriod_s);
      both += a * b;
      one += a * a;
      other += b * b;
    }
    if (one <= 0.0 || other <= 0.0) continue;
    const double alike = std::abs(both) / std::sqrt(one * other);
    if (alike <= best) continue;
    best = alike;
    best_lag_s = lag_s;
  }
  return best >= kClear ? std::optional(best_lag_s) : std::nullopt;
}

}  // namespace trailcast::agent
