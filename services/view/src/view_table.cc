#include "services/view/view_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "services/view/src/likest.h"

namespace trailcast::view {
namespace {

// Each seen feature with the one of `key` that is most like it.
std::vector<Comparison::Pair> FindAlike(const ViewTable& key, const ViewTable& seen,
                                        const ComparisonOptions& options) {
  constexpr int kNone = std::numeric_limits<int>::max();
  struct Claim {
    std::size_t key = 0;
    int bits = kNone;
  };
  std::vector<Claim> claims(seen.size());
  for (std::size_t i = 0; i < key.size(); ++i) {
    Likest likest(seen, options.elsewhere);
    for (std::size_t j = 0; j < seen.size(); ++j) {
      likest.Offer(j, Hamming(key.bits[i], seen.bits[j]));
    }
    const auto nearest = likest.Found(options.max_hamming_bits, options.hamming_ratio);
    if (!nearest) continue;
    Claim& claim = claims[nearest->seen];
    if (nearest->bits < claim.bits) claim = {i, nearest->bits};
  }
  std::vector<Comparison::Pair> pairs;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (claims[i].bits != kNone) pairs.push_back({claims[i].key, i});
  }
  return pairs;
}

// Two views and what may be alike in them.
class Agreement {
 public:
  Agreement(const ViewTable& key, const ViewTable& seen, const ComparisonOptions& options)
      : key_(key), seen_(seen), options_(options), alike_(FindAlike(key, seen, options)) {}

  [[nodiscard]] Comparison Best() const {
    double likeness = 0.0;
    Fit best;
    for (std::size_t a = 1; a < alike_.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const auto fit = FitTwo(key_, seen_, alike_[a], alike_[b], options_.shortest_base);
        if (!fit || fit->scale < options_.least_scale || fit->scale > options_.most_scale) continue;
        const double found = Likeness(*fit);
        if (found <= likeness) continue;
        likeness = found;
        best = *fit;
      }
    }
    if (likeness == 0.0) return {};
    Comparison comparison = LeastSquares(Belonging(best));
    comparison.likeness = likeness;
    return comparison;
  }

 private:
  // 0 for a pair that does not belong to the fit, else up to 1.
  [[nodiscard]] double Belongs(const Comparison::Pair& pair, const Fit& fit,
                               double log_scale) const {
    const double off_u = std::abs(seen_.u[pair.seen] - fit.scale * key_.u[pair.key] - fit.shift_u) /
                         options_.agree_u;
    const double off_v = std::abs(seen_.v[pair.seen] - fit.scale * key_.v[pair.key] - fit.shift_v) /
                         options_.agree_v;
    const double off = std::max(off_u, off_v);
    if (off >= 1.0) return 0.0;
    // False where one of the sizes is not known.
    const double grown = seen_.log_size[pair.seen] - key_.log_size[pair.key];
    if (std::abs(grown - log_scale) > options_.agree_log_size) return 0.0;
    return 1.0 - off * off;
  }

  [[nodiscard]] double Likeness(const Fit& fit) const {
    const double log_scale = std::log(fit.scale);
    double sum = 0.0;
    for (const Comparison::Pair& pair : alike_) sum += Belongs(pair, fit, log_scale);
    return sum;
  }

  [[nodiscard]] std::vector<Comparison::Pair> Belonging(const Fit& fit) const {
    const double log_scale = std::log(fit.scale);
    std::vector<Comparison::Pair> pairs;
    for (const Comparison::Pair& pair : alike_) {
      if (Belongs(pair, fit, log_scale) > 0.0) pairs.push_back(pair);
    }
    return pairs;
  }

  [[nodiscard]] Comparison LeastSquares(std::vector<Comparison::Pair> pairs) const {
    const auto n = static_cast<double>(pairs.size());
    double key_u = 0.0, key_v = 0.0, u = 0.0, v = 0.0;
    for (const Comparison::Pair& pair : pairs) {
      key_u += key_.u[pair.key] / n;
      key_v += key_.v[pair.key] / n;
      u += seen_.u[pair.seen] / n;
      v += seen_.v[pair.seen] / n;
    }
    double cross = 0.0, square = 0.0;
    for (const Comparison::Pair& pair : pairs) {
      const double du = key_.u[pair.key] - key_u;
      const double dv = key_.v[pair.key] - key_v;
      cross += du * (seen_.u[pair.seen] - u) + dv * (seen_.v[pair.seen] - v);
      square += du * du + dv * dv;
    }
    Comparison comparison;
    comparison.scale = square > 0.0 && cross > 0.0 ? cross / square : 1.0;
    comparison.shift_u = u - comparison.scale * key_u;
    comparison.shift_v = v - comparison.scale * key_v;
    comparison.pairs = std::move(pairs);
    return comparison;
  }

  const ViewTable& key_;
  const ViewTable& seen_;
  const ComparisonOptions& options_;
  std::vector<Comparison::Pair> alike_;
};

}  // namespace

route::View Spread(const route::View& view, std::size_t most) {
  if (view.size() <= most) return view;
  // Each with the distance to the nearest stronger one.
  std::vector<std::pair<float, std::size_t>> alone;
  alone.reserve(view.size());
  for (std::size_t i = 0; i < view.size(); ++i) {
    float nearest = std::numeric_limits<float>::max();
    for (std::size_t j = 0; j < i; ++j) {
      const float du = view[i].u_px - view[j].u_px;
      const float dv = view[i].v_px - view[j].v_px;
      nearest = std::min(nearest, du * du + dv * dv);
    }
    alone.emplace_back(-nearest, i);
  }
  std::sort(alone.begin(), alone.end());
  route::View kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < most; ++i) kept.push_back(view[alone[i].second]);
  return kept;
}

ViewTable Tabulate(std::span<const route::ViewFeature> view, double width_px) {
  ViewTable table;
  const float to_half_widths = static_cast<float>(2.0 / width_px);
  for (const route::ViewFeature& feature : view) {
    if (!route::IsDescribed(feature.descriptor)) continue;
    std::memcpy(table.bits.emplace_back().data(), feature.descriptor.data(),
                feature.descriptor.size());
    table.u.push_back(to_half_widths * feature.u_px);
    table.v.push_back(to_half_widths * feature.v_px);
    table.log_size.push_back(feature.size_px > 0.0F ? std::log(to_half_widths * feature.size_px)
                                                    : std::numeric_limits<float>::quiet_NaN());
  }
  return table;
}

Comparison Compare(const ViewTable& key, const ViewTable& seen, const ComparisonOptions& options) {
  return Agreement(key, seen, options).Best();
}

}  // namespace trailcast::view
