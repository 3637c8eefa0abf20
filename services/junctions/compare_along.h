#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/junctions/find_junctions.h"
#include "services/route/route.h"

namespace trailcast::junctions {

// A part of a route along which another route goes the same way, and the differences there.
struct Part {
  double begin = 0.0;  // along the first route, in its units
  double end = 0.0;
  double begin_b = 0.0;  // along the other route, in its units
  double end_b = 0.0;
  int features = 0;  // features of the first route that were looked for in the other
  int stayed = 0;    // how many of these were found
  int came = 0;      // features of the other route that the first does not have
  // How many features of the first route its own neighbouring views show as well. In a sharp turn
  // or before a wall these are few, and the other route cannot be expected to show more.
  int shown_again = 0;
  // How far the other path lies to the left of the first, negative to the right, if both have
  // odometry. It is fitted to the motion within kFitted_m, so that deviations that both share do
  // not show.
  std::optional<double> aside_m{};

  [[nodiscard]] int went() const { return features - stayed; }
  [[nodiscard]] double share() const { return features > 0 ? 1.0 * stayed / features : 0.0; }
  bool operator==(const Part&) const = default;
};

struct Comparison {
  // One route is the other one refreshed, so they are compared segment by segment, each feature
  // with itself. Otherwise they are compared by their key views, in which a feature that is still
  // there is not always found.
  bool refreshed = false;
  bool metric = true;  // units are metres; otherwise seconds of teaching
  bool metric_b = true;
  double length = 0.0;  // of the first route, in its units
  // The parts in which they go the same way: one segment of the first route each, or several short
  // ones.
  std::vector<Part> parts;
};

struct ComparisonRoute {
  std::span<const route::Segment> segments;
  int width_px = 0;  // width of the scout's pictures, above 0
};

inline constexpr double kFitted_m = 8.0;

// Compares two routes, or two revisions of one. With `whole` they are taken to go the same way from
// their beginnings as far as both reach, even where nothing in them is alike. A result without
// parts means that they do not go the same way. It is deterministic.
[[nodiscard]] Comparison CompareAlong(const ComparisonRoute& a, const ComparisonRoute& b,
                                      bool same_camera, bool whole,
                                      const JunctionOptions& options = {});

// Returns the parts that differ: clearly fewer features stayed than elsewhere, relative to what
// their own views show again, or the path was moved aside. Consecutive parts are merged.
[[nodiscard]] std::vector<Part> Differing(std::span<const Part> parts);
// Merges at least one part into one, with `aside_m` from where it is largest.
[[nodiscard]] Part Together(std::span<const Part> parts);

}  // namespace trailcast::junctions
