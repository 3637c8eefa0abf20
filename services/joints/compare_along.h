#pragma once

#include <optional>
#include <span>
#include <vector>

#include "services/joints/find_joints.h"
#include "services/route/route.h"

namespace trailcast::joints {

// A part of a route along which another goes the same way, and what is otherwise on it.
struct Part {
  double begin = 0.0;  // along the first route, in its units
  double end = 0.0;
  double begin_b = 0.0;  // along the other, in its
  double end_b = 0.0;
  int features = 0;  // of the first route, looked for in the other
  int stayed = 0;    // of these, found
  int came = 0;      // of the other, and not in the first
  // Features of the first that its own other views near by show, too: in a sharp turn, or before a
  // wall, few are, and the other route is not to have more.
  int shown_again = 0;
  // How far the other's path lies to the left of the first's, negative to the right; where both
  // have odometry, by what they do within kFitted_m of it: what both do alike does not show.
  std::optional<double> aside_m{};

  [[nodiscard]] int went() const { return features - stayed; }
  [[nodiscard]] double share() const { return features > 0 ? 1.0 * stayed / features : 0.0; }
  bool operator==(const Part&) const = default;
};

struct Comparison {
  // The one is the other refreshed: they are compared segment by segment, each feature with itself.
  // Else by their key views, in which a feature that stayed is not always found again.
  bool refreshed = false;
  bool metric = true;  // units are metres; else seconds of teaching
  bool metric_b = true;
  double length = 0.0;  // of the first route, in its units
  // Where they go the same way: a segment of the first each, or several short ones.
  std::vector<Part> parts;
};

struct ComparisonRoute {
  std::span<const route::Segment> segments;
  int width_px = 0;  // of the scout's pictures, above 0
};

inline constexpr double kFitted_m = 8.0;

// Two routes, or two revisions of one, which are taken to go the same way from the one's beginning
// to its end (`whole`) as far as they are as long, even where nothing in them is alike. Without
// parts: they do not go the same way. Deterministic.
[[nodiscard]] Comparison CompareAlong(const ComparisonRoute& a, const ComparisonRoute& b,
                                      bool same_camera, bool whole,
                                      const JointOptions& options = {});

// Parts of which clearly less stayed than of the others, for as many as their own views show again,
// or whose path was moved aside; those in a row as one.
[[nodiscard]] std::vector<Part> Differing(std::span<const Part> parts);
// All as one; `aside_m` where it is furthest. At least one.
[[nodiscard]] Part Together(std::span<const Part> parts);

}  // namespace trailcast::joints
