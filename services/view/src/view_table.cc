#include "services/view/view_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "services/view/src/likest.h"

namespace trailcast::view {
namespace {

// Returns each seen feature with the one of `key` that is most similar to it.
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

// These are the pairs in the layout for trying hundreds of fits on them: side by side, so that a
// processor handles several at once, and padded with pairs that belong to no fit.
class Row {
 public:
  Row(const ViewTable& key, const ViewTable& seen, std::span<const Comparison::Pair> pairs,
      const ComparisonOptions& options)
      : per_u_(static_cast<float>(1.0 / options.agree_u)),
        per_v_(static_cast<float>(1.0 / options.agree_v)),
        most_grown_(static_cast<float>(std::exp(options.agree_log_size))) {
    constexpr float kNowhere = 1e9F;
    const std::size_t filled = (pairs.size() + kLanes - 1) / kLanes * kLanes;
    key_u_.resize(filled);
    key_v_.resize(filled);
    seen_u_.resize(filled, kNowhere);
    seen_v_.resize(filled, kNowhere);
    grown_.resize(filled);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      key_u_[i] = key.u[pairs[i].key];
      key_v_[i] = key.v[pairs[i].key];
      seen_u_[i] = seen.u[pairs[i].seen];
      seen_v_[i] = seen.v[pairs[i].seen];
      grown_[i] = std::exp(seen.log_size[pairs[i].seen] - key.log_size[pairs[i].key]);
    }
  }

  // Returns the sum over the pairs that belong to the fit. Each counts less the further off it is.
  [[nodiscard]] float Likeness(const Fit& fit) const {
    const auto scale = static_cast<float>(fit.scale);
    const auto shift_u = static_cast<float>(fit.shift_u);
    const auto shift_v = static_cast<float>(fit.shift_v);
    const float most = scale * most_grown_;
    const float least = scale / most_grown_;
    std::array<float, kLanes> sums{};
    for (std::size_t i = 0; i < key_u_.size(); i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t at = i + lane;
        const float off_u = std::abs(seen_u_[at] - scale * key_u_[at] - shift_u) * per_u_;
        const float off_v = std::abs(seen_v_[at] - scale * key_v_[at] - shift_v) * per_v_;
        const float off = off_u > off_v ? off_u : off_v;
        const float near = 1.0F - off * off;
        float belongs = near > 0.0F ? near : 0.0F;
        // False where one of the sizes is not known.
        belongs = grown_[at] > most ? 0.0F : belongs;
        sums[lane] += grown_[at] < least ? 0.0F : belongs;
      }
    }
    return std::accumulate(sums.begin(), sums.end(), 0.0F);
  }

 private:
  static constexpr std::size_t kLanes = 8;

  float per_u_;
  float per_v_;
  float most_grown_;
  std::vector<float> key_u_, key_v_, seen_u_, seen_v_;
  std::vector<float> grown_;  // growth from the key view to the seen one; NaN if not known
};

// This finds what two views have in common.
class Agreement {
 public:
  Agreement(const ViewTable& key, const ViewTable& seen, const ComparisonOptions& options)
      : key_(key),
        seen_(seen),
        options_(options),
        alike_(FindAlike(key, seen, options)),
        row_(key, seen, alike_, options) {}

  [[nodiscard]] Comparison Best() const {
    float likeness = 0.0F;
    Fit best;
    for (std::size_t a = 1; a < alike_.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const auto fit = FitTwo(key_, seen_, alike_[a], alike_[b], options_.shortest_base);
        if (!fit || fit->scale < options_.least_scale || fit->scale > options_.most_scale) continue;
        const float found = row_.Likeness(*fit);
        if (found <= likeness) continue;
        likeness = found;
        best = *fit;
      }
    }
    if (likeness == 0.0F) return {};
    Comparison comparison = LeastSquares(Belonging(best));
    comparison.likeness = likeness;
    return comparison;
  }

 private:
  [[nodiscard]] bool Belongs(const Comparison::Pair& pair, const Fit& fit, double log_scale) const {
    const double off_u = seen_.u[pair.seen] - fit.scale * key_.u[pair.key] - fit.shift_u;
    const double off_v = seen_.v[pair.seen] - fit.scale * key_.v[pair.key] - fit.shift_v;
    // False where one of the sizes is not known.
    const double grown = seen_.log_size[pair.seen] - key_.log_size[pair.key];
    return std::abs(off_u) < options_.agree_u && std::abs(off_v) < options_.agree_v &&
           !(std::abs(grown - log_scale) > options_.agree_log_size);
  }

  [[nodiscard]] std::vector<Comparison::Pair> Belonging(const Fit& fit) const {
    const double log_scale = std::log(fit.scale);
    std::vector<Comparison::Pair> pairs;
    for (const Comparison::Pair& pair : alike_) {
      if (Belongs(pair, fit, log_scale)) pairs.push_back(pair);
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
  Row row_;
};

}  // namespace

route::View Spread(const route::View& view, std::size_t most) {
  if (view.size() <= most) return view;
  // These have the distance of each to the nearest stronger one.
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
