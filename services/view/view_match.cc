#include "services/view/view_match.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "services/route/track.h"

namespace trailcast::view {
namespace {

int Hamming(const route::Descriptor& a, const route::Descriptor& b) {
  int bits = 0;
  for (std::size_t i = 0; i < a.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t left = 0;
    std::uint64_t right = 0;
    std::memcpy(&left, &a[i], sizeof(left));
    std::memcpy(&right, &b[i], sizeof(right));
    bits += std::popcount(left ^ right);
  }
  return bits;
}

struct Alike {
  const route::Feature* taught = nullptr;
  const route::ViewFeature* seen = nullptr;
};

// The feature of the view most like the taught one, if it is like enough and no other is nearly so.
struct Nearest {
  std::size_t seen = 0;
  int bits = 0;
};
std::optional<Nearest> MostAlike(std::span<const route::ViewFeature> view,
                                 const route::Descriptor& wanted, const ViewMatchOptions& options) {
  const int none = 8 * static_cast<int>(wanted.size()) + 1;
  Nearest nearest{0, none};
  int second = none;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const int bits = Hamming(view[i].descriptor, wanted);
    if (bits < nearest.bits) {
      second = nearest.bits;
      nearest = {i, bits};
    } else {
      second = std::min(second, bits);
    }
  }
  if (nearest.bits > options.max_hamming_bits) return std::nullopt;
  if (nearest.bits > options.hamming_ratio * second) return std::nullopt;
  return nearest;
}

// Each feature of the view with the taught one that is most like it.
std::vector<Alike> FindAlike(std::span<const route::ViewFeature> view,
                             const route::Segment& segment, const ViewMatchOptions& options) {
  struct Claim {
    const route::Feature* taught = nullptr;
    int bits = 0;
  };
  std::vector<Claim> claims(view.size());
  for (const route::Feature& feature : segment.features) {
    if (!route::IsDescribed(feature.descriptor)) continue;
    const auto nearest = MostAlike(view, feature.descriptor, options);
    if (!nearest) continue;
    Claim& claim = claims[nearest->seen];
    if (claim.taught == nullptr || nearest->bits < claim.bits) claim = {&feature, nearest->bits};
  }
  std::vector<Alike> pairs;
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (claims[i].taught != nullptr) pairs.push_back({claims[i].taught, &view[i]});
  }
  return pairs;
}

struct Pair {
  double taught_u, taught_v, u, v;
};

struct Tolerance {
  double u_px = 0.0;
  double v_px = 0.0;
};

// One magnification and one shift of the whole picture.
struct Fit {
  double scale = 1.0;
  double shift_u = 0.0;
  double shift_v = 0.0;
};

// What carries two pairs over exactly (the scale in the least-squares sense).
std::optional<Fit> FitTwo(const Pair& a, const Pair& b, const Tolerance& tolerance,
                          const ViewMatchOptions& options) {
  const double du = b.taught_u - a.taught_u;
  const double dv = b.taught_v - a.taught_v;
  const double base = du * du + dv * dv;
  if (base < 4.0 * tolerance.u_px * tolerance.u_px) return std::nullopt;
  const double scale = (du * (b.u - a.u) + dv * (b.v - a.v)) / base;
  if (scale < options.least_scale || scale > options.most_scale) return std::nullopt;
  return Fit{scale, a.u - scale * a.taught_u, a.v - scale * a.taught_v};
}

// The pairs that agree on it count the more the better they do, and all of them the less the more
// the picture is magnified: the place itself shows things as large as they were taught.
ViewMatch Judge(const std::vector<Pair>& pairs, const Fit& fit, const Tolerance& tolerance) {
  ViewMatch match;
  for (const Pair& pair : pairs) {
    const double off_u = (pair.u - fit.scale * pair.taught_u - fit.shift_u) / tolerance.u_px;
    const double off_v = (pair.v - fit.scale * pair.taught_v - fit.shift_v) / tolerance.v_px;
    const double off = std::max(std::abs(off_u), std::abs(off_v));
    if (off > 1.0) continue;
    ++match.agreed;
    match.likeness += 1.0 - off * off;
  }
  match.likeness /= 1.0 + std::abs(std::log(fit.scale));
  return match;
}

// With the segment's features where they were at fraction `s` of it.
ViewMatch MatchAt(const std::vector<Alike>& alike, double s, const Tolerance& tolerance,
                  const ViewMatchOptions& options) {
  std::vector<Pair> pairs;
  pairs.reserve(alike.size());
  for (const Alike& each : alike) {
    const route::TrackKnot taught = route::TaughtPlace(*each.taught, s);
    pairs.push_back({taught.u_px, taught.v_px, each.seen->u_px, each.seen->v_px});
  }
  ViewMatch best;
  for (std::size_t a = 1; a < pairs.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const auto fit = FitTwo(pairs[a], pairs[b], tolerance, options);
      if (!fit) continue;
      const ViewMatch match = Judge(pairs, *fit, tolerance);
      if (match.likeness > best.likeness) best = match;
    }
  }
  return best;
}

}  // namespace

ViewMatch Match(std::span<const route::ViewFeature> view, const route::Segment& segment,
                const ViewMatchOptions& options) {
  constexpr std::array kPlaces = {0.0, 0.25, 0.5, 0.75, 1.0};
  double half_width_px = 0.0;
  for (const route::ViewFeature& feature : view) {
    half_width_px = std::max(half_width_px, static_cast<double>(std::abs(feature.u_px)));
  }
  const Tolerance tolerance{options.agree_u * half_width_px, options.agree_v * half_width_px};
  const std::vector<Alike> alike = FindAlike(view, segment, options);
  ViewMatch best;
  if (alike.size() < ViewMatch::kEnough) return best;
  for (const double s : kPlaces) {
    const ViewMatch match = MatchAt(alike, s, tolerance, options);
    if (match.likeness > best.likeness) best = match;
  }
  return best;
}

}  // namespace trailcast::view
