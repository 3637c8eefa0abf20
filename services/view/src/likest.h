#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "services/view/view_table.h"

namespace trailcast::view {

// This finds the feature most similar to another among those of a view, which are offered one by
// one. It must be similar enough, and no feature elsewhere in the picture may be nearly as similar.
// The same corner on the pyramid's next level does not count as a rival.
class Likest {
 public:
  struct Nearest {
    std::size_t seen = 0;
    int bits = std::numeric_limits<int>::max();
  };

  // A feature is elsewhere if it is further than `elsewhere` away, in half widths.
  Likest(const ViewTable& seen, double elsewhere) : seen_(seen), elsewhere_(elsewhere) {}

  void Offer(std::size_t seen, int bits) {
    if (bits >= second_) return;
    const bool rival = nearest_.bits == Nearest{}.bits || IsElsewhere(seen);
    if (bits < nearest_.bits) {
      if (rival) second_ = nearest_.bits;
      nearest_ = {seen, bits};
    } else if (rival) {
      second_ = bits;
    }
  }

  [[nodiscard]] std::optional<Nearest> Found(int most_bits, double ratio) const {
    if (nearest_.bits > most_bits || nearest_.bits > ratio * second_) return std::nullopt;
    return nearest_;
  }

 private:
  [[nodiscard]] bool IsElsewhere(std::size_t seen) const {
    return std::abs(seen_.u[seen] - seen_.u[nearest_.seen]) > elsewhere_ ||
           std::abs(seen_.v[seen] - seen_.v[nearest_.seen]) > elsewhere_;
  }

  const ViewTable& seen_;
  double elsewhere_;
  Nearest nearest_;
  int second_ = Nearest{}.bits;
};

// This is one magnification and one shift of a picture, in half widths.
struct Fit {
  double scale = 1.0;
  double shift_u = 0.0;
  double shift_v = 0.0;
};

// Returns the fit that maps the first of two pairs exactly, and the second, too, with the scale by
// least squares. Returns nothing if they are closer together than `shortest_base`.
[[nodiscard]] inline std::optional<Fit> FitTwo(const ViewTable& key, const ViewTable& seen,
                                               const Comparison::Pair& a, const Comparison::Pair& b,
                                               double shortest_base) {
  const double du = key.u[b.key] - key.u[a.key];
  const double dv = key.v[b.key] - key.v[a.key];
  const double base = du * du + dv * dv;
  if (base < shortest_base * shortest_base) return std::nullopt;
  const double scale =
      (du * (seen.u[b.seen] - seen.u[a.seen]) + dv * (seen.v[b.seen] - seen.v[a.seen])) / base;
  return Fit{scale, seen.u[a.seen] - scale * key.u[a.key], seen.v[a.seen] - scale * key.v[a.key]};
}

}  // namespace trailcast::view
