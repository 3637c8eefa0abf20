#include "services/odometry/turn_series.h"

#include <algorithm>
#include <cmath>

namespace trailcast::odometry {
namespace {

constexpr double kLagStep_s = 0.01;
constexpr std::size_t kFewest = 10;

// Returns Pearson's correlation of the changes over a period, with those of `reference` taken
// `lag_s` earlier.
double Correlation(const std::vector<TimedValue>& series, const std::vector<TimedValue>& reference,
                   double lag_s, double period_s) {
  double a = 0.0;
  double b = 0.0;
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
  double count = 0.0;
  const double begins_s = std::max(series.front().t_s, reference.front().t_s + lag_s) + period_s;
  const double ends_s = reference.back().t_s + lag_s;
  for (const TimedValue& each : series) {
    if (each.t_s < begins_s || each.t_s > ends_s) continue;
    const double one = each.value - ValueAt(series, each.t_s - period_s);
    const double other =
        ValueAt(reference, each.t_s - lag_s) - ValueAt(reference, each.t_s - lag_s - period_s);
    a += one;
    b += other;
    aa += one * one;
    ab += one * other;
    bb += other * other;
    count += 1.0;
  }
  if (count < static_cast<double>(kFewest)) return 0.0;
  const double one = aa - a * a / count;
  const double other = bb - b * b / count;
  // A change as small as a rounding error is none.
  constexpr double kNone = 1e-12;
  if (one <= kNone * (1.0 + aa) || other <= kNone * (1.0 + bb)) return 0.0;
  return (ab - a * b / count) / std::sqrt(one * other);
}

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

std::optional<Lag> LagOf(const std::vector<TimedValue>& series,
                         const std::vector<TimedValue>& reference, const LagOptions& options) {
  if (series.size() < kFewest || reference.size() < kFewest) return std::nullopt;
  const int steps = static_cast<int>(std::lround(options.longest_s / kLagStep_s));
  Lag best;
  int best_step = 0;
  for (int step = -steps; step <= steps; ++step) {
    const double lag_s = step * kLagStep_s;
    const double correlation = Correlation(series, reference, lag_s, options.period_s);
    if (std::abs(correlation) <= std::abs(best.correlation)) continue;
    best = {lag_s, correlation};
    best_step = step;
  }
  if (std::abs(best.correlation) < options.clear || std::abs(best_step) == steps) {
    return std::nullopt;
  }
  return best;
}

}  // namespace trailcast::odometry
