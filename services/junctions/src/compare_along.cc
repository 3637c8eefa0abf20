#include "services/junctions/compare_along.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/median.h"
#include "services/junctions/src/taught_path.h"
#include "services/view/key_views.h"

namespace trailcast::junctions {
namespace {

using route::Segment;

// Refreshing does not change a route's path.
bool HaveOnePath(std::span<const Segment> a, std::span<const Segment> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Segment& x, const Segment& y) {
    return x.length_m == y.length_m && x.duration_s == y.duration_s && x.heading == y.heading &&
           x.heading_change_rad == y.heading_change_rad &&
           view::ScoutViewsOf(x) == view::ScoutViewsOf(y);
  });
}

// The count of visits that missed it does not matter.
bool IsSame(const route::Feature& a, const route::Feature& b) {
  return a.patch == b.patch && a.track == b.track && a.descriptor == b.descriptor;
}

int CountSame(const std::vector<route::Feature>& a, const std::vector<route::Feature>& b) {
  std::vector<bool> taken(b.size());
  int same = 0;
  for (const route::Feature& each : a) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (taken[i] || !IsSame(each, b[i])) continue;
      taken[i] = true;
      ++same;
      break;
    }
  }
  return same;
}

std::vector<Part> PartsOf(std::span<const Segment> segments) {
  std::vector<Part> parts;
  double along = 0.0;
  for (const Segment& segment : segments) {
    Part& part = parts.emplace_back();
    part.begin = along;
    along += segment.extent();
    part.end = along;
  }
  return parts;
}

std::vector<Part> CompareRefreshed(std::span<const Segment> a, std::span<const Segment> b) {
  std::vector<Part> parts = PartsOf(a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    Part& part = parts[i];
    part.begin_b = part.begin;
    part.end_b = part.end;
    part.features = static_cast<int>(a[i].features.size());
    part.stayed = CountSame(a[i].features, b[i].features);
    part.came = static_cast<int>(b[i].features.size()) - part.stayed;
    part.shown_again = part.features;
  }
  return parts;
}

// A place along A and the place along B that corresponds to it.
struct Knot {
  double a = 0.0;
  double b = 0.0;
};

// Returns the junctions that lie in order along both routes and have the most evidence together.
std::vector<Junction> InOrder(std::vector<Junction> junctions) {
  std::sort(junctions.begin(), junctions.end(),
            [](const Junction& x, const Junction& y) { return x.at_a < y.at_a; });
  std::vector<double> sums(junctions.size());
  std::vector<std::optional<std::size_t>> befores(junctions.size());
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (junctions[j].end_a > junctions[i].at_a || junctions[j].end_b > junctions[i].at_b)
        continue;
      if (sums[j] <= sums[i]) continue;
      sums[i] = sums[j];
      befores[i] = j;
    }
    sums[i] += junctions[i].evidence;
    if (!best || sums[i] > sums[*best]) best = i;
  }
  std::vector<Junction> chosen;
  for (auto i = best; i; i = befores[*i]) chosen.push_back(junctions[*i]);
  std::reverse(chosen.begin(), chosen.end());
  return chosen;
}

// Maps two routes onto each other, linearly between the ends of their junctions.
class Alignment {
 public:
  Alignment(const std::vector<Junction>& junctions, const RouteViews& a, const RouteViews& b,
            bool whole, const JunctionOptions& options)
      : slack_(options.slack_m), slack_share_(options.slack_share) {
    for (const Junction& junction : junctions) {
      Add({junction.at_a, junction.at_b});
      Add({junction.end_a, junction.end_b});
    }
    if (knots_.empty() || !whole) return;
    // Speeds of teaching that differ are not known beyond the ends.
    const Knot first = knots_.front();
    const Knot last = knots_.back();
    const double before = std::min(first.a - a.begin(), first.b - b.begin());
    const double after = std::min(a.end() - last.a, b.end() - last.b);
    if (before > 0.0) knots_.insert(knots_.begin(), {first.a - before, first.b - before});
    if (after > 0.0) knots_.push_back({last.a + after, last.b + after});
  }

  // Both return nothing where the routes do not go the same way.
  [[nodiscard]] std::optional<double> OnB(double a) const { return At(a, &Knot::a, &Knot::b); }
  [[nodiscard]] std::optional<double> OnA(double b) const { return At(b, &Knot::b, &Knot::a); }

 private:
  void Add(const Knot& knot) {
    if (knots_.empty() || (knot.a > knots_.back().a && knot.b > knots_.back().b)) {
      knots_.push_back(knot);
    }
  }

  [[nodiscard]] std::optional<double> At(double along, double Knot::*from, double Knot::*to) const {
    const auto after =
        std::lower_bound(knots_.begin(), knots_.end(), along,
                         [from](const Knot& knot, double value) { return knot.*from < value; });
    if (after == knots_.end()) return std::nullopt;
    if ((*after).*from == along) return (*after).*to;
    if (after == knots_.begin()) return std::nullopt;
    const Knot& before = *std::prev(after);
    const double way_a = after->a - before.a;
    const double way_b = after->b - before.b;
    const double longer = std::max(way_a, way_b);
    if (std::abs(way_a - way_b) > slack_ + slack_share_ * longer) return std::nullopt;
    const double share = (along - before.*from) / ((*after).*from - before.*from);
    return before.*to + share * ((*after).*to - before.*to);
  }

  double slack_;
  double slack_share_;
  std::vector<Knot> knots_;  // rising in both
};

int CountFound(const std::vector<bool>& found) {
  return static_cast<int>(std::count(found.begin(), found.end(), true));
}

// Returns the views near that place with about the same heading. In a turn, other views say nothing
// about it.
std::vector<std::size_t> ViewsAbout(const RouteViews& route, double along, bool reverse) {
  constexpr double kNear = 1.5;
  constexpr double kAsTurned_rad = 0.3;
  std::vector<std::size_t> about;
  if (route.views().empty()) return about;
  const double heading = route.HeadingAt(along);
  for (std::size_t i = 0; i < route.views().size(); ++i) {
    const RouteViews::View& view = route.views()[i];
    if (std::abs(view.along - along) > kNear || view.reverse != reverse) continue;
    if (std::abs(view.heading - heading) <= kAsTurned_rad) about.push_back(i);
  }
  return about;
}

std::vector<view::Comparison::Pair> InCommon(const RouteViews::View& one,
                                             const RouteViews::View& other,
                                             const JunctionOptions& options) {
  auto found = view::Compare(one.table, other.table, options.comparison);
  if (found.agreed() < options.least_agreed) return {};
  return std::move(found.pairs);
}

// Records which features of either route's views were found in the other's nearby.
class Sighted {
 public:
  Sighted(const RouteViews& a, const RouteViews& b, const Alignment& alignment,
          const JunctionOptions& options)
      : a_(a), b_(b), in_a_(a.views().size()), in_b_(b.views().size()), options_(options) {
    for (std::size_t i = 0; i < a.views().size(); ++i) {
      if (const auto on_b = alignment.OnB(a.views()[i].along)) Look(i, *on_b);
    }
  }

  // Each has one value for each feature, or none if no view was to be compared with it.
  [[nodiscard]] const std::vector<bool>& in_a(std::size_t view) const { return in_a_[view]; }
  [[nodiscard]] const std::vector<bool>& in_b(std::size_t view) const { return in_b_[view]; }

 private:
  void Look(std::size_t i, double on_b) {
    const RouteViews::View& one = a_.views()[i];
    for (const std::size_t j : ViewsAbout(b_, on_b, one.reverse)) {
      const RouteViews::View& other = b_.views()[j];
      in_a_[i].resize(one.table.size());
      in_b_[j].resize(other.table.size());
      for (const auto& pair : InCommon(one, other, options_)) {
        in_a_[i][pair.key] = in_b_[j][pair.seen] = true;
      }
    }
  }

  const RouteViews& a_;
  const RouteViews& b_;
  std::vector<std::vector<bool>> in_a_;
  std::vector<std::vector<bool>> in_b_;
  const JunctionOptions& options_;
};

// Counts a view's features that the route's own neighbouring views show.
int CountShownAgain(const RouteViews& route, std::size_t i, const JunctionOptions& options) {
  const RouteViews::View& view = route.views()[i];
  std::vector<bool> again(view.table.size());
  for (const std::size_t j : ViewsAbout(route, view.along, view.reverse)) {
    if (j == i) continue;
    for (const auto& pair : InCommon(view, route.views()[j], options)) again[pair.key] = true;
  }
  return CountFound(again);
}

// Returns the part that a place lies on, if there is one.
Part* PartAt(std::vector<Part>& parts, double along) {
  const auto at =
      std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return along <= part.end; });
  return at == parts.end() ? nullptr : &*at;
}

RouteViews ViewsOf(const ComparisonRoute& route) {
  RouteViews views(route.width_px);
  for (const Segment& segment : route.segments) views.Add(segment);
  return views;
}

std::vector<Part> CompareByViews(const ComparisonRoute& a, const ComparisonRoute& b,
                                 bool same_camera, bool whole, const JunctionOptions& options) {
  const RouteViews views_a = ViewsOf(a);
  const RouteViews views_b = ViewsOf(b);
  const Alignment alignment(InOrder(FindJunctions(views_a, views_b, same_camera, options)), views_a,
                            views_b, whole, options);
  const Sighted sighted(views_a, views_b, alignment, options);
  std::vector<Part> parts = PartsOf(a.segments);
  for (std::size_t i = 0; i < views_a.views().size(); ++i) {
    const double along = views_a.views()[i].along;
    Part* const part = PartAt(parts, along);
    if (part == nullptr || !alignment.OnB(along)) continue;
    part->features += static_cast<int>(sighted.in_a(i).size());
    part->stayed += CountFound(sighted.in_a(i));
    if (!sighted.in_a(i).empty()) part->shown_again += CountShownAgain(views_a, i, options);
  }
  for (std::size_t j = 0; j < views_b.views().size(); ++j) {
    const auto on_a = alignment.OnA(views_b.views()[j].along);
    Part* const part = on_a ? PartAt(parts, *on_a) : nullptr;
    if (part == nullptr) continue;
    part->came += static_cast<int>(sighted.in_b(j).size()) - CountFound(sighted.in_b(j));
  }
  std::optional<PathsAside> aside;
  if (views_a.metric() && views_b.metric()) {
    aside.emplace(TaughtPath(a.segments), TaughtPath(b.segments),
                  [&](double along) { return alignment.OnB(along); });
  }
  std::vector<Part> shared;
  for (Part& part : parts) {
    const double middle = 0.5 * (part.begin + part.end);
    const auto on_b = alignment.OnB(middle);
    if (!on_b) continue;
    part.begin_b = alignment.OnB(part.begin).value_or(*on_b);
    part.end_b = alignment.OnB(part.end).value_or(*on_b);
    if (aside) part.aside_m = aside->At(middle, kFitted_m);
    shared.push_back(part);
  }
  return shared;
}

// Segments before a turn or a wall are short. Several of them make one part, and a rest at the end
// joins the part before.
std::vector<Part> NotShort(const std::vector<Part>& parts) {
  constexpr double kShortest = 1.0;
  constexpr double kNothing = 1e-6;
  const auto is_short = [](const Part& part) {
    return part.end - part.begin + kNothing < kShortest;
  };
  std::vector<Part> joined;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool goes_on = !joined.empty() && joined.back().end + kNothing >= parts[i].begin;
    const bool is_last = i + 1 == parts.size();
    if (goes_on && (is_short(joined.back()) || (is_last && is_short(parts[i])))) {
      const Part both[] = {joined.back(), parts[i]};
      joined.back() = Together(both);
    } else {
      joined.push_back(parts[i]);
    }
  }
  return joined;
}

bool IsMetric(std::span<const Segment> segments) {
  return !segments.empty() && segments.front().has_odometry;
}

}  // namespace

Comparison CompareAlong(const ComparisonRoute& a, const ComparisonRoute& b, bool same_camera,
                        bool whole, const JunctionOptions& options) {
  Comparison comparison{.refreshed = HaveOnePath(a.segments, b.segments),
                        .metric = IsMetric(a.segments),
                        .metric_b = IsMetric(b.segments),
                        .parts = {}};
  for (const Segment& segment : a.segments) comparison.length += segment.extent();
  comparison.parts =
      NotShort(comparison.refreshed ? CompareRefreshed(a.segments, b.segments)
                                    : CompareByViews(a, b, same_camera, whole, options));
  return comparison;
}

Part Together(std::span<const Part> parts) {
  Part all = parts.front();
  for (const Part& part : parts.subspan(1)) {
    all.end = part.end;
    all.end_b = part.end_b;
    all.features += part.features;
    all.stayed += part.stayed;
    all.came += part.came;
    all.shown_again += part.shown_again;
    if (std::abs(part.aside_m.value_or(0.0)) > std::abs(all.aside_m.value_or(0.0))) {
      all.aside_m = part.aside_m;
    }
  }
  return all;
}

std::vector<Part> Differing(std::span<const Part> parts) {
  constexpr int kEnough = 8;  // features that a share needs
  constexpr double kClearly = 0.6;
  constexpr double kSigmas = 2.0;
  constexpr double kAside_m = 0.3;
  std::vector<double> shares;
  for (const Part& part : parts) {
    if (part.shown_again >= kEnough) shares.push_back(1.0 * part.stayed / part.shown_again);
  }
  const double usual = shares.empty() ? 0.0 : trailcast::Median(std::move(shares));
  const auto has_fewer = [&](const Part& part) {
    const double expected = usual * part.shown_again;
    return part.shown_again >= kEnough && part.stayed < kClearly * expected &&
           expected - part.stayed > kSigmas * std::sqrt(expected);
  };
  const auto is_aside = [&](const Part& part) {
    return std::abs(part.aside_m.value_or(0.0)) > kAside_m;
  };
  const auto differs = [&](std::size_t i) {
    // One segment alone says little.
    const std::size_t first = i - std::min<std::size_t>(i, 1);
    const std::size_t end = std::min(parts.size(), i + 2);
    return has_fewer(Together(parts.subspan(first, end - first))) || is_aside(parts[i]);
  };
  std::vector<Part> differing;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!differs(i)) continue;
    const std::size_t first = i;
    while (i + 1 < parts.size() && differs(i + 1)) ++i;
    const Part section = Together(parts.subspan(first, i + 1 - first));
    if (has_fewer(section) || is_aside(section)) differing.push_back(section);
  }
  return differing;
}

}  // namespace trailcast::junctions
