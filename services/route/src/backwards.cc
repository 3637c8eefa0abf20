#include "services/route/backwards.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::route {
namespace {

constexpr double kMean = 8.0;  // of a patch
constexpr double kMost = 15.0;
// A pattern that is enlarged more than this is blurred.
constexpr double kLargest = 3.0;
constexpr double kNearAxis_px = 10.0;

// Returns h(L - x) - h(L), the heading by the metres x from the other end, and relative to that
// end.
HeadingPolynomial FromTheEnd(const HeadingPolynomial& heading, double length_m) {
  const auto& c = heading.c;
  return {{-(c[0] + length_m * (2.0 * c[1] + 3.0 * length_m * c[2])), c[1] + 3.0 * length_m * c[2],
           -c[2]}};
}

double Sample(const Patch& patch, double x, double y) {
  const auto at = [&](int column, int row) {
    const int last = kPatchSize - 1;
    return static_cast<double>(
        patch[static_cast<std::size_t>(std::clamp(row, 0, last)) * kPatchSize +
              static_cast<std::size_t>(std::clamp(column, 0, last))]);
  };
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const double right = x - column;
  const double down = y - row;
  return (1.0 - down) * ((1.0 - right) * at(column, row) + right * at(column + 1, row)) +
         down * ((1.0 - right) * at(column, row + 1) + right * at(column + 1, row + 1));
}

// Returns the patch's middle, enlarged, with the contrast that patches have.
Patch Enlarged(const Patch& patch, double times) {
  std::array<double, std::tuple_size_v<Patch>> grey{};
  const double middle = 0.5 * (kPatchSize - 1);
  double most = 0.0;
  double mean = 0.0;
  for (int row = 0; row < kPatchSize; ++row) {
    for (int column = 0; column < kPatchSize; ++column) {
      const double value =
          Sample(patch, middle + (column - middle) / times, middle + (row - middle) / times);
      grey[static_cast<std::size_t>(row) * kPatchSize + static_cast<std::size_t>(column)] = value;
      mean += value / static_cast<double>(grey.size());
    }
  }
  for (const double value : grey) most = std::max(most, std::abs(value - mean));
  const double gain = most > 0.0 ? (kMean - 1.0) / most : 1.0;
  Patch enlarged{};
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const double value = std::clamp(std::round(kMean + gain * (grey[i] - mean)), 0.0, kMost);
    enlarged[i] = static_cast<std::uint8_t>(value);
  }
  return enlarged;
}

// A camera that moves along its axis and turns by little sees a feature that was at p at p' = g p +
// t, where g is its growth as it came nearer, and t the turn, which is the same for all features.
// The turn is the t that makes p' - t parallel to p in least squares.
struct Shift {
  double u_px = 0.0;
  double v_px = 0.0;
};

Shift Turned(const Segment& segment) {
  double uu = 1e-9;
  double uv = 0.0;
  double vv = 1e-9;
  double u = 0.0;
  double v = 0.0;
  for (const Feature& feature : segment.features) {
    const double from_axis = std::hypot(feature.first().u_px, feature.first().v_px);
    if (from_axis < kNearAxis_px) continue;
    const double across_u = feature.first().v_px / from_axis;
    const double across_v = -feature.first().u_px / from_axis;
    const double moved = across_u * feature.milestone().u_px + across_v * feature.milestone().v_px;
    uu += across_u * across_u;
    uv += across_u * across_v;
    vv += across_v * across_v;
    u += across_u * moved;
    v += across_v * moved;
  }
  const double determinant = uu * vv - uv * uv;
  return {(vv * u - uv * v) / determinant, (uu * v - uv * u) / determinant};
}

// Returns how much larger each feature's pattern is at the segment's end than at its beginning.
// Features near the axis hardly move, so they get the median of all others.
std::vector<double> Growths(const Segment& segment) {
  const Shift turned = Turned(segment);
  std::vector<double> growths;
  std::vector<double> sorted;
  for (const Feature& feature : segment.features) {
    const auto& [s, u_px, v_px] = feature.first();
    const double squared = u_px * u_px + v_px * v_px;
    const double along = u_px * (feature.milestone().u_px - turned.u_px) +
                         v_px * (feature.milestone().v_px - turned.v_px);
    const bool near_axis = squared < kNearAxis_px * kNearAxis_px;
    growths.push_back(near_axis ? 0.0 : along / squared);
    if (!near_axis) sorted.push_back(growths.back());
  }
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = sorted.empty() ? 1.0 : *middle;
  for (double& growth : growths) {
    growth = std::clamp(growth == 0.0 ? usual : growth, 1.0, kLargest);
  }
  return growths;
}

}  // namespace

Segment FromOtherEnd(const Segment& segment) {
  Segment other = segment;
  other.heading = FromTheEnd(segment.heading, segment.length_m);
  other.heading_change_rad = -segment.heading_change_rad;
  for (Feature& feature : other.features) {
    std::reverse(feature.track.begin(), feature.track.end());
    for (TrackKnot& knot : feature.track) knot.s = 1.0F - knot.s;
  }
  std::reverse(other.key_views.begin(), other.key_views.end());
  for (KeyView& view : other.key_views) view.s = 1.0 - view.s;
  std::stable_sort(
      other.key_views.begin(), other.key_views.end(), [](const KeyView& a, const KeyView& b) {
        return std::pair(a.s, a.missed.has_value()) < std::pair(b.s, b.missed.has_value());
      });
  if (other.terrain.slope_rad) other.terrain.slope_rad = -*other.terrain.slope_rad;
  return other;
}

Result<std::vector<Segment>> DrivenBackwards(const std::vector<Segment>& route) {
  std::vector<Segment> back;
  back.reserve(route.size());
  double turn_rad = 0.0;  // turned before the segment that was driven later
  for (auto it = route.rbegin(); it != route.rend(); ++it) {
    if (it->reverse) {
      return Fail(ErrorCode::kInvalidArgument,
                  "segment {} was taught driving backwards, and is not driven in the other gear",
                  it->index.value());
    }
    if (!it->has_odometry) {
      return Fail(ErrorCode::kInvalidArgument,
                  "segment {} was taught without odometry, by which a robot backs",
                  it->index.value());
    }
    Segment segment = FromOtherEnd(*it);
    const std::vector<double> growths = Growths(*it);
    for (std::size_t i = 0; i < growths.size(); ++i) {
      segment.features[i].patch = Enlarged(segment.features[i].patch, growths[i]);
    }
    segment.index = SegmentIndex(static_cast<std::uint32_t>(back.size()));
    segment.reverse = true;
    segment.duration_s /= kBackwardsPace;
    segment.turn_before_rad = -std::exchange(turn_rad, it->turn_before_rad);
    back.push_back(std::move(segment));
  }
  return back;
}

}  // namespace trailcast::route
