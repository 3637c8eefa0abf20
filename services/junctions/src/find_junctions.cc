#include "services/junctions/find_junctions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace trailcast::junctions {
namespace {

// Two views that match.
struct Alike {
  std::size_t a = 0;  // positions
  std::size_t b = 0;
  double at_a = 0.0;
  double at_b = 0.0;  // where on B things look as large as in A's view, once that is known
  int agreed = 0;
  double log_scale = 0.0;  // scale from A's picture to B's
  double shift_u = 0.0;    // half widths
  double turned = 0.0;     // B's taught heading less A's
  double worth = 0.0;
};

Alike Describe(const RouteViews& a, std::size_t i, const RouteViews& b, std::size_t j,
               const view::Comparison& comparison) {
  const RouteViews::View& one = a.views()[i];
  const RouteViews::View& other = b.views()[j];
  return {i,
          j,
          one.along,
          other.along,
          comparison.agreed(),
          std::log(comparison.scale),
          comparison.shift_u,
          other.heading - one.heading,
          0.0};
}

bool GivesUp(const JunctionOptions& options) { return options.give_up && options.give_up(); }

std::vector<Alike> FindAlike(const RouteViews& a, const RouteViews& b,
                             const JunctionOptions& options) {
  std::vector<Alike> found;
  for (std::size_t i = 0; i < a.views().size(); ++i) {
    if (a.views()[i].reverse) continue;
    if (found.size() >= options.most_alike || GivesUp(options)) break;
    for (std::size_t j = 0; j < b.views().size(); ++j) {
      if (b.views()[j].reverse) continue;
      const auto comparison =
          view::Compare(a.views()[i].table, b.views()[j].table, options.comparison);
      if (comparison.agreed() < options.least_agreed) continue;
      found.push_back(Describe(a, i, b, j, comparison));
    }
  }
  return found;
}

// Does the same within one route, for later views after others in between that match nothing.
std::vector<Alike> FindAlike(const RouteViews& route, const JunctionOptions& options) {
  constexpr int kLeft = 2;  // consecutive views
  std::vector<Alike> found;
  for (std::size_t i = 0; i < route.views().size(); ++i) {
    if (route.views()[i].reverse) continue;
    if (found.size() >= options.most_alike || GivesUp(options)) break;
    int unlike = 0;
    for (std::size_t j = i + 1; j < route.views().size(); ++j) {
      if (route.views()[j].reverse) continue;
      const auto comparison =
          view::Compare(route.views()[i].table, route.views()[j].table, options.comparison);
      const bool alike = comparison.agreed() >= options.least_agreed;
      if (unlike < kLeft) {
        unlike = alike ? 0 : unlike + 1;
      } else if (alike) {
        found.push_back(Describe(route, i, route, j, comparison));
      }
    }
  }
  return found;
}

// Returns how much larger B's camera shows things. Turns tell it; otherwise the views with most in
// common do, because they are from about one place.
double LogMagnification(std::span<const Alike> alike, int least_agreed) {
  constexpr double kSigma = 0.08;
  double best = 0.0;
  double most = 0.0;
  for (const Alike& candidate : alike) {
    double sum = 0.0;
    for (const Alike& each : alike) {
      const double off = (each.log_scale - candidate.log_scale) / kSigma;
      const double weight = each.agreed - least_agreed + 1;
      sum += weight * weight * std::exp(-0.5 * off * off);
    }
    if (sum > most) {
      most = sum;
      best = candidate.log_scale;
    }
  }
  return best;
}

double LogMagnification(const RouteViews& a, const RouteViews& b, std::span<const Alike> alike,
                        int least_agreed) {
  const auto turning_a = a.half_widths_a_radian();
  const auto turning_b = b.half_widths_a_radian();
  if (turning_a && turning_b) return std::log(*turning_b / *turning_a);
  return LogMagnification(alike, least_agreed);
}

// Features that match between two views are further away than those that were tracked from one to
// the next, and so grow less. Returns their share of that growth, from pairs that share a view and
// match neighbours on the other route.
double ShareOfGrowth(const RouteViews& a, const RouteViews& b, std::span<const Alike> alike,
                     bool metric) {
  constexpr std::size_t kEnough = 3;
  constexpr std::size_t kNeighbours = 2;
  constexpr double kLeast = 0.3;
  std::vector<Weighed> shares;
  for (std::size_t i = 0; i < alike.size(); ++i) {
    for (std::size_t j = i + 1; j < alike.size(); ++j) {
      const Alike& x = alike[i];
      const Alike& y = alike[j];
      if (y.a > x.a + kNeighbours) break;
      double grown = 0.0;
      if (y.a == x.a && y.b <= x.b + kNeighbours) {
        grown = (y.at_b - x.at_b) * 0.5 * (b.views()[x.b].growth + b.views()[y.b].growth);
      }
      if (metric && y.b == x.b) {
        grown = (x.at_a - y.at_a) * 0.5 * (a.views()[x.a].growth + a.views()[y.a].growth);
      }
      if (std::abs(grown) < 0.05) continue;  // too little to be measured
      shares.push_back({(y.log_scale - x.log_scale) / grown, 1.0 * std::min(x.agreed, y.agreed)});
    }
  }
  if (shares.size() < kEnough) return 1.0;
  return std::clamp(*Median(std::move(shares)), kLeast, 1.0);
}

class Finder {
 public:
  Finder(std::vector<Alike> alike, const RouteViews& a, const RouteViews& b, bool same_camera,
         const JunctionOptions& options)
      : alike_(std::move(alike)),
        metric_(a.metric() && b.metric()),
        loop_(&a == &b),
        b_(b),
        options_(options) {
    if (!same_camera) log_magnification_ = LogMagnification(a, b, alike_, options_.least_agreed);
    const double share = ShareOfGrowth(a, b, alike_, metric_);
    for (Alike& each : alike_) {
      const double off = each.log_scale - log_magnification_;
      each.at_b -= Moved(off, 0.5 * share * (a.views()[each.a].growth + b.views()[each.b].growth));
      const double scales =
          off / (same_camera ? options_.log_scale_sigma : options_.other_camera_sigma);
      const double shifts = each.shift_u / options_.shift_sigma;
      each.worth = (each.agreed - options_.least_agreed + 1) *
                   std::exp(-0.5 * (scales * scales + shifts * shifts));
    }
  }

  std::vector<Junction> All() {
    std::vector<Junction> junctions;
    while (junctions.size() < options_.most_junctions && !GivesUp(options_)) {
      const std::vector<std::size_t> chain = BestChain();
      if (chain.empty()) break;
      if (Evidence(chain) < options_.least_evidence) break;
      if (chain.size() >= options_.least_views) {
        const Junction junction = JunctionOf(chain);
        if (!loop_ || ComesBack(junction)) junctions.push_back(junction);
      }
      TakeOut(chain);
    }
    return junctions;
  }

 private:
  // Returns how much further along a view is in which things look so much larger. Where they hardly
  // grow, their size says little about the place.
  [[nodiscard]] double Moved(double log_scale, double growth) const {
    if (growth <= 0.0) return 0.0;
    const double sigma = metric_ ? options_.off_sigma_m : options_.off_sigma_s;
    const double untold = options_.log_scale_noise / (growth * sigma);
    return std::clamp(log_scale / growth / (1.0 + untold * untold), -2.0 * sigma, 2.0 * sigma);
  }

  // Says whether this is more than a section along which things change slowly.
  [[nodiscard]] bool ComesBack(const Junction& junction) const {
    return junction.at_b - junction.at_a >=
           std::max(options_.least_loop, std::min(junction.length(), options_.sure_loop));
  }

  [[nodiscard]] bool TooFarOnA(const Alike& before, const Alike& after) const {
    return after.a - before.a > options_.most_passed_over + 1 &&
           after.at_a - before.at_a > options_.most_apart;
  }

  [[nodiscard]] bool Follows(const Alike& before, const Alike& after) const {
    if (after.a <= before.a || after.b <= before.b) return false;
    const double way_a = after.at_a - before.at_a;
    const double way_b = after.at_b - before.at_b;
    if (way_b < 0.0) return false;
    if (after.b - before.b > options_.most_passed_over + 1 && way_b > options_.most_apart) {
      return false;
    }
    const double longer = std::max(way_a, way_b);
    if (metric_) {
      return std::abs(way_a - way_b) <= options_.slack_m + options_.slack_share * longer;
    }
    return longer <= options_.most_pace * std::min(way_a, way_b) + 1.0;
  }

  [[nodiscard]] std::vector<std::size_t> BestChain() const {
    constexpr auto kNone = std::numeric_limits<std::size_t>::max();
    std::vector<double> sums(alike_.size());
    std::vector<std::size_t> befores(alike_.size(), kNone);
    std::size_t best = kNone;
    for (std::size_t i = 0; i < alike_.size() && !GivesUp(options_); ++i) {
      for (std::size_t j = i; j-- > 0;) {
        if (TooFarOnA(alike_[j], alike_[i])) break;  // as are all before it
        if (sums[j] <= sums[i] || !Follows(alike_[j], alike_[i])) continue;
        sums[i] = sums[j];
        befores[i] = j;
      }
      sums[i] += alike_[i].worth;
      if (best == kNone || sums[i] > sums[best]) best = i;
    }
    std::vector<std::size_t> chain;
    for (std::size_t i = best; i != kNone; i = befores[i]) chain.push_back(i);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

  [[nodiscard]] double Evidence(std::span<const std::size_t> chain) const {
    double sum = 0.0;
    for (const std::size_t i : chain) sum += alike_[i].worth;
    return sum;
  }

  // Removes all pairs that repeat or contradict what the chain says.
  void TakeOut(std::span<const std::size_t> chain) {
    const Alike first = alike_[chain.front()];
    const Alike last = alike_[chain.back()];
    const double near = options_.most_apart;
    std::erase_if(alike_, [&](const Alike& each) {
      return each.at_a >= first.at_a - near && each.at_a <= last.at_a + near &&
             each.at_b >= first.at_b - near && each.at_b <= last.at_b + near;
    });
  }

  [[nodiscard]] Junction JunctionOf(std::span<const std::size_t> chain) const {
    Junction junction;
    junction.views = static_cast<int>(chain.size());
    junction.evidence = Evidence(chain);
    junction.confidence = 1.0 - std::exp2(-junction.evidence / options_.least_evidence);
    junction.log_scale = log_magnification_;
    for (const std::size_t i : chain) junction.features += alike_[i].agreed;
    std::tie(junction.at_a, junction.at_b) = PlacesAt(chain, alike_[chain.front()]);
    std::tie(junction.end_a, junction.end_b) = PlacesAt(chain, alike_[chain.back()]);
    junction.end_a = std::max(junction.at_a, junction.end_a);
    junction.end_b = std::max(junction.at_b, junction.end_b);
    SetHeading(chain, junction);
    return junction;
  }

  // Returns where both routes are at this pair of the chain; beyond its ends, the ends hold.
  [[nodiscard]] std::pair<double, double> PlacesAt(std::span<const std::size_t> chain,
                                                   const Alike& pair) const {
    // Without odometry the speed of teaching is not known, so the pair alone counts.
    if (!metric_) return {pair.at_a, std::clamp(pair.at_b, b_.begin(), b_.end())};
    constexpr double kNear_m = 4.0;
    std::vector<Weighed> offsets;
    for (const std::size_t i : chain) {
      if (std::abs(alike_[i].at_a - pair.at_a) > kNear_m) continue;
      offsets.push_back({alike_[i].at_b - alike_[i].at_a, alike_[i].worth});
    }
    const double offset = *Median(std::move(offsets));
    const double at_b = std::clamp(pair.at_a + offset, b_.begin(), b_.end());
    return {at_b - offset, at_b};
  }

  void SetHeading(std::span<const std::size_t> chain, Junction& junction) const {
    constexpr double kHalfWidthsARadian = 1.73;  // for a camera of 60 degrees
    const auto told = b_.half_widths_a_radian();
    junction.heading_scaled = told.has_value();
    const double half_widths = told.value_or(kHalfWidthsARadian);
    std::vector<Weighed> headings;
    for (const std::size_t i : chain) {
      const Alike& each = alike_[i];
      const double turned_since = b_.HeadingAt(each.at_b) - b_.views()[each.b].heading;
      headings.push_back({each.shift_u / half_widths + turned_since, each.worth});
    }
    junction.heading_rad = *Median(std::move(headings));
  }

  std::vector<Alike> alike_;  // by A's views, then by B's
  bool metric_;
  bool loop_;
  const RouteViews& b_;
  JunctionOptions options_;
  double log_magnification_ = 0.0;
};

}  // namespace

std::vector<Junction> FindJunctions(const RouteViews& a, const RouteViews& b, bool same_camera,
                                    const JunctionOptions& options) {
  return Finder(FindAlike(a, b, options), a, b, same_camera, options).All();
}

std::vector<Junction> FindLoops(const RouteViews& route, const JunctionOptions& options) {
  return Finder(FindAlike(route, options), route, route, true, options).All();
}

}  // namespace trailcast::junctions
