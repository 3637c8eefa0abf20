#include "services/odometry/src/turn_fit.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "services/base/median.h"
#include "services/base/square.h"

namespace trailcast::odometry {
namespace {

constexpr std::size_t kFewestPairs = 20;
constexpr double kLeastSpread_radps = 0.04;  // spread of the picture's rates below which nothing
                                             // turns
constexpr int kIterations = 20;
constexpr double kLeastNoise_radps = 0.01;
constexpr std::size_t kParts = 4;

struct Line {
  double scale = 0.0;
  double drift_radps = 0.0;
  double noise_radps = 0.0;  // 1.48 times the median distance
};

double Off(const Line& line, const TurnPair& pair) {
  return pair.odometry_radps - line.scale * pair.picture_radps - line.drift_radps;
}

double NoiseAbout(const Line& line, std::span<const TurnPair> pairs) {
  std::vector<double> off;
  off.reserve(pairs.size());
  for (const TurnPair& pair : pairs) off.push_back(std::abs(Off(line, pair)));
  return 1.48 * Median(std::move(off));
}

struct Moments {
  double weight = 0.0;
  double p = 0.0;
  double o = 0.0;
  double pp = 0.0;
  double po = 0.0;
};

Moments Weighed(std::span<const TurnPair> pairs, const Line* line) {
  Moments sum;
  for (const TurnPair& pair : pairs) {
    const double width_radps =
        line == nullptr ? 1.0 : std::max(kLeastNoise_radps, 2.0 * line->noise_radps);
    const double weight =
        line == nullptr ? 1.0 : 1.0 / (1.0 + Square(Off(*line, pair) / width_radps));
    sum.weight += weight;
    sum.p += weight * pair.picture_radps;
    sum.o += weight * pair.odometry_radps;
    sum.pp += weight * Square(pair.picture_radps);
    sum.po += weight * pair.picture_radps * pair.odometry_radps;
  }
  return sum;
}

// Returns the spread of the picture's rates about their mean.
double SpreadOf(const Moments& sum) {
  return std::sqrt(std::max(0.0, sum.pp / sum.weight - Square(sum.p / sum.weight)));
}

std::optional<Line> FitLine(std::span<const TurnPair> pairs) {
  if (pairs.size() < kFewestPairs) return std::nullopt;
  Line line;
  Moments sum = Weighed(pairs, nullptr);
  for (int i = 0; i < kIterations; ++i) {
    if (SpreadOf(sum) < kLeastSpread_radps) return std::nullopt;
    line.scale = (sum.po - sum.p * sum.o / sum.weight) / (sum.pp - Square(sum.p) / sum.weight);
    line.drift_radps = (sum.o - line.scale * sum.p) / sum.weight;
    line.noise_radps = NoiseAbout(line, pairs);
    sum = Weighed(pairs, &line);
  }
  return line;
}

}  // namespace

std::optional<TurnFit> FitTurn(const std::vector<TurnPair>& pairs) {
  const auto whole = FitLine(pairs);
  if (!whole) return std::nullopt;
  TurnFit fit{whole->scale, whole->scale, whole->scale, whole->drift_radps, whole->noise_radps};
  const std::span all(pairs);
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t begin = part * all.size() / kParts;
    const auto line = FitLine(all.subspan(begin, (part + 1) * all.size() / kParts - begin));
    if (!line) continue;
    fit.least_scale = std::min(fit.least_scale, line->scale);
    fit.most_scale = std::max(fit.most_scale, line->scale);
  }
  return fit;
}

}  // namespace trailcast::odometry
