#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "services/route/key_view.h"

namespace trailcast::view {

// Returns the features to keep of a view if only `most` can be kept: strong ones, spread over the
// picture, in that order (Brown et al. 2005: each is the strongest within as large a radius as
// possible).
[[nodiscard]] route::View Spread(const route::View& view, std::size_t most);

// This is a view prepared once for comparisons. Places and sizes are in half widths of its picture,
// so that views from cameras of any resolution can be compared.
struct ViewTable {
  using Bits = std::array<std::uint64_t, 4>;

  std::vector<Bits> bits;
  std::vector<float> u, v;
  std::vector<float> log_size;  // natural logarithm; NaN if not known

  [[nodiscard]] std::size_t size() const { return bits.size(); }
};

// Returns the number of bits in which two descriptors differ.
[[nodiscard]] inline int Hamming(const ViewTable::Bits& a, const ViewTable::Bits& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) +
         std::popcount(a[3] ^ b[3]);
}

// Returns the table of a view without those features that have no descriptor.
[[nodiscard]] ViewTable Tabulate(std::span<const route::ViewFeature> view, double width_px);

struct ComparisonOptions {
  int max_hamming_bits = 72;   // of 256
  double hamming_ratio = 0.9;  // best to second best that is elsewhere in the picture
  double elsewhere = 0.03;     // half widths
  // A feature may be so far from where one magnification and one shift of the whole picture put it,
  // in half widths. Sideways displacement moves near features along u and none along v.
  double agree_u = 0.10;
  double agree_v = 0.04;
  // These limit the magnification of the second view's camera against the first's, which includes
  // the ratio of their fields of view.
  double least_scale = 0.4;
  double most_scale = 2.5;
  double agree_log_size = 0.35;  // between a feature's growth and the magnification
  double shortest_base = 0.2;  // half widths; closer than this, the scale by two features is noise
};

// These are the features that two views have in common: they look alike and lie where one
// magnification and one shift put them.
struct Comparison {
  struct Pair {
    std::size_t key = 0;   // position in the first view
    std::size_t seen = 0;  // and in the second
  };
  std::vector<Pair> pairs;  // pairs that agree
  double likeness = 0.0;    // their number, weighted by how well they agree
  // u = scale u_key + shift_u, in half widths, by least squares over the pairs.
  double scale = 1.0;
  double shift_u = 0.0;
  double shift_v = 0.0;

  [[nodiscard]] int agreed() const { return static_cast<int>(pairs.size()); }
};

// Compares two views. The result is deterministic.
[[nodiscard]] Comparison Compare(const ViewTable& key, const ViewTable& seen,
                                 const ComparisonOptions& options = {});

}  // namespace trailcast::view
