#include "services/network/network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace trailcast::network {
namespace {

// A robot that has arrived may report a place a little beyond the end.
constexpr double kBeyondEnd_m = 0.5;
constexpr double kNever = std::numeric_limits<double>::infinity();
// This is above the cost of any path, so that closed parts are searched last: one search finds the
// path that there is, and what blocks it.
constexpr double kClosedCosts = 1e15;

}  // namespace

void Section::BeginAt(double along_m) {
  from_m = AlongAfter(std::clamp(DrivenAt(along_m), 0.0, length_m()));
}

bool GoesOn(const Section& before, const Section& next) {
  return before.route == next.route && std::abs(before.to_m - next.from_m) <= kSame_m &&
         before.backwards() == next.backwards() && next.turn_rad == 0.0;
}

double LengthOf(std::span<const Section> sections) {
  double length_m = 0.0;
  for (const Section& section : sections) length_m += section.length_m();
  return length_m;
}

// This collects drives from the last to the first, as a search finds them, without empty ones.
class Network::Drives {
 public:
  void Prepend(Index route, double from_m, double to_m) {
    if (from_m == to_m) return;
    const bool goes_on = !drives_.empty() && !junction_ &&
                         (drives_.back().to_m < drives_.back().from_m) == (to_m < from_m);
    if (goes_on) {
      drives_.back().from_m = from_m;
    } else {
      drives_.push_back({route, from_m, to_m});
    }
    junction_ = false;
  }
  void PrependJunction(double turn_rad) {
    if (!drives_.empty()) drives_.back().turn_rad += turn_rad;
    junction_ = true;
  }
  [[nodiscard]] std::vector<Drive> Take() {
    std::reverse(drives_.begin(), drives_.end());
    return std::move(drives_);
  }

 private:
  std::vector<Drive> drives_;
  bool junction_ = false;  // a junction comes before the last one
};

Result<Network> Network::Build(std::vector<Route> routes, const std::vector<Junction>& junctions,
                               std::span<const Condition> conditions) {
  Network network;
  network.routes_ = std::move(routes);
  for (Index i = 0; i < network.routes_.size(); ++i) {
    if (!network.by_id_.emplace(network.routes_[i].id, i).second) {
      return Fail(ErrorCode::kInvalidArgument, "two routes with the id {}", network.routes_[i].id);
    }
  }
  for (const Junction& junction : junctions) {
    for (const Place* place : {&junction.from, &junction.to}) {
      if (const auto found = network.Find(*place); !found) {
        return Fail(ErrorCode::kInvalidArgument, "a junction: {}", found.error().message);
      }
    }
  }
  network.PlaceNodes(junctions, conditions);
  network.Weigh(conditions);
  network.Link(junctions);
  return network;
}

Result<Network::Spot> Network::Find(const Place& place) const {
  const auto at = by_id_.find(place.route);
  if (at == by_id_.end()) {
    return Fail(ErrorCode::kNotFound, "there is no route '{}' in the network", place.route);
  }
  const Route& route = routes_[at->second];
  if (!(place.along_m >= 0.0 && place.along_m <= route.length_m + kBeyondEnd_m)) {
    return Fail(ErrorCode::kNotFound, "route '{}' is {:.1f} m long: there is no {:g} m on it",
                route.name, route.length_m, place.along_m);
  }
  return Spot{at->second, std::min(place.along_m, route.length_m)};
}

void Network::PlaceNodes(const std::vector<Junction>& junctions,
                         std::span<const Condition> conditions) {
  const auto add = [this](const Spot& spot) {
    nodes_.push_back({.route = spot.route, .along_m = spot.along_m});
  };
  for (Index i = 0; i < routes_.size(); ++i) {
    add({i, 0.0});
    add({i, routes_[i].length_m});
  }
  for (const Junction& junction : junctions) {
    add(*Find(junction.from));
    add(*Find(junction.to));
  }
  for (const Condition& condition : conditions) {
    const auto at = by_id_.find(condition.route);
    if (at == by_id_.end()) continue;
    const double end_m = routes_[at->second].length_m;
    add({at->second, std::clamp(condition.from_m, 0.0, end_m)});
    add({at->second, std::clamp(condition.to_m, 0.0, end_m)});
  }
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

void Network::Weigh(std::span<const Condition> conditions) {
  for (const Condition& condition : conditions) {
    const auto at = by_id_.find(condition.route);
    if (at == by_id_.end()) continue;
    const double end_m = routes_[at->second].length_m;
    const Index last = NodeAt({at->second, std::clamp(condition.to_m, 0.0, end_m)});
    for (Index i = NodeAt({at->second, std::clamp(condition.from_m, 0.0, end_m)}); i < last; ++i) {
      nodes_[i].closed |= condition.closed;
      nodes_[i].backed |= condition.backed;
      nodes_[i].speed = std::min(nodes_[i].speed, condition.speed);
      nodes_[i].cost *= condition.cost;
    }
  }
}

void Network::Link(const std::vector<Junction>& junctions) {
  for (const Junction& junction : junctions) {
    const Index from = NodeAt(*Find(junction.from));
    const Index to = NodeAt(*Find(junction.to));
    const double turn_rad = junction.lie ? junction.lie->turn_rad : 0.0;
    const float turns_rad =
        std::abs(turn_rad) > kTurnsFrom_rad ? static_cast<float>(turn_rad) : 0.0F;
    leaps_.push_back({from, to, turns_rad});
    if (junction.both) leaps_.push_back({to, from, -turns_rad});
  }
  std::sort(leaps_.begin(), leaps_.end());
  auto next = leaps_.cbegin();
  for (Index i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    while (next != leaps_.cend() && next->from < i) ++next;
    const bool is_first = i == 0 || nodes_[i - 1].route != node.route;
    const bool is_last = i + 1 == nodes_.size() || nodes_[i + 1].route != node.route;
    exits_.push_back({.ahead = is_last ? kNever : Costs(i, node.along_m, nodes_[i + 1].along_m),
                      .first_leap = static_cast<Index>(next - leaps_.cbegin()),
                      .back = !is_first && nodes_[i - 1].backed});
  }
  exits_.push_back({.first_leap = static_cast<Index>(leaps_.size())});
}

Network::Index Network::NodeAt(const Spot& spot) const {
  const auto after = std::upper_bound(
      nodes_.begin(), nodes_.end(), spot, [](const Spot& sought, const Node& node) {
        return std::pair(sought.route, sought.along_m) < std::pair(node.route, node.along_m);
      });
  return static_cast<Index>(after - nodes_.begin()) - 1;
}

double Network::Costs(Index node, double from_m, double to_m, bool though_closed) const {
  if (to_m <= from_m) return 0.0;
  const Node& of = nodes_[node];
  return (of.closed && !though_closed ? kClosedCosts : 0.0) + (to_m - from_m) * of.cost / of.speed;
}

// This is Dijkstra's algorithm, from node to node. The goal is reached on the way from its node.
Network::Found Network::Search(const Spot& from, const Spot& to, const Open& open) const {
  constexpr Index kNone = std::numeric_limits<Index>::max();
  struct Reached {
    double cost = kNever;
    Index before = kNone;  // the node before it
    Index leap = kNone;    // junction that led here
  };
  std::vector<Reached> reached(nodes_.size());
  using Due = std::pair<double, Index>;
  std::priority_queue<Due, std::vector<Due>, std::greater<>> due;
  const auto reach = [&](Index node, double cost, Index before, Index leap) {
    if (!(cost < reached[node].cost)) return;
    reached[node] = {cost, before, leap};
    due.emplace(cost, node);
  };

  const Index goal = NodeAt(to);
  const Index begin = NodeAt(from);
  const auto is_open = [&](Index node) { return node >= open.first && node < open.end; };
  const auto ahead = [&](Index node, double from_m, double to_m) {
    return Costs(node, from_m, to_m, node >= begin && is_open(node));
  };
  const auto back = [&](Index node, double from_m, double to_m) {
    return kBackwardsCosts * Costs(node, to_m, from_m, node <= begin && is_open(node));
  };
  double best = kNever;
  Index last = kNone;  // the node before the goal; kNone if one drives there straight
  if (begin == goal && from.along_m <= to.along_m) {
    best = ahead(begin, from.along_m, to.along_m);
  } else if (begin == goal && nodes_[begin].backed) {
    best = back(begin, from.along_m, to.along_m);
  }
  if (nodes_[begin].along_m >= from.along_m) {
    reach(begin, 0.0, kNone, kNone);
  } else {
    reach(begin + 1, ahead(begin, from.along_m, nodes_[begin + 1].along_m), kNone, kNone);
    if (nodes_[begin].backed) {
      reach(begin, back(begin, from.along_m, nodes_[begin].along_m), kNone, kNone);
    }
  }
  while (!due.empty() && due.top().first < best) {
    const auto [cost, node] = due.top();
    due.pop();
    if (cost > reached[node].cost) continue;
    const Exits& exits = exits_[node];
    double all = kNever;
    if (node == goal) {
      all = cost + ahead(node, nodes_[node].along_m, to.along_m);
    } else if (exits.back && node == goal + 1) {
      all = cost + back(goal, nodes_[node].along_m, to.along_m);
    }
    if (all < best) {
      best = all;
      last = node;
    }
    if (exits.ahead < kNever) {
      const double on =
          is_open(node) ? ahead(node, nodes_[node].along_m, nodes_[node + 1].along_m) : exits.ahead;
      reach(node + 1, cost + on, node, kNone);
    }
    if (exits.back) {
      reach(node - 1, cost + back(node - 1, nodes_[node].along_m, nodes_[node - 1].along_m), node,
            kNone);
    }
    for (Index i = exits.first_leap; i < exits_[node + 1].first_leap; ++i) {
      const double turn = leaps_[i].turn_rad != 0.0F ? kTurnCosts_m : 0.0;
      reach(leaps_[i].to, cost + kChangeCosts_m + turn, node, i);
    }
  }
  Drives drives;
  if (last == kNone) {
    drives.Prepend(from.route, from.along_m, to.along_m);
    return {.cost = best, .drives = drives.Take()};
  }
  drives.Prepend(to.route, nodes_[last].along_m, to.along_m);
  Index node = last;
  for (; reached[node].before != kNone; node = reached[node].before) {
    const auto& [cost, before, leap] = reached[node];
    if (leap != kNone) {
      drives.PrependJunction(leaps_[leap].turn_rad);
    } else {
      drives.Prepend(nodes_[node].route, nodes_[before].along_m, nodes_[node].along_m);
    }
  }
  drives.Prepend(from.route, from.along_m, nodes_[node].along_m);
  return {.cost = best, .drives = drives.Take()};
}

Way Network::WayOf(const std::vector<Drive>& drives) const {
  Way way;
  for (const Drive& drive : drives) {
    const bool back = drive.to_m < drive.from_m;
    double turn_rad = drive.turn_rad;
    bool goes_on = false;
    double at_m = drive.from_m;
    Index i = NodeAt({drive.route, drive.from_m});
    if (back && nodes_[i].along_m >= at_m) --i;
    while (at_m != drive.to_m) {
      const double end_m = back ? std::max(nodes_[i].along_m, drive.to_m)
                                : std::min(nodes_[i + 1].along_m, drive.to_m);
      if (goes_on && way.sections.back().speed == nodes_[i].speed) {
        way.sections.back().to_m = end_m;
      } else {
        way.sections.push_back({.route = routes_[drive.route].id,
                                .from_m = at_m,
                                .to_m = end_m,
                                .speed = nodes_[i].speed,
                                .turn_rad = std::exchange(turn_rad, 0.0)});
        goes_on = true;
      }
      at_m = end_m;
      i += back ? -1 : 1;
    }
  }
  way.length_m = LengthOf(way.sections);
  return way;
}

std::string Network::ClosedOn(const std::vector<Drive>& drives) const {
  std::string text;
  for (const Drive& drive : drives) {
    const auto [from_m, to_m] = std::minmax(drive.from_m, drive.to_m);
    Index i = NodeAt({drive.route, from_m});
    while (i + 1 < nodes_.size() && nodes_[i].route == drive.route && nodes_[i].along_m < to_m) {
      Index end = i;
      while (nodes_[end].closed) ++end;
      if (end > i) {
        text += fmt::format("{}{} {:g}..{:g}", text.empty() ? "" : ", ", routes_[drive.route].name,
                            nodes_[i].along_m, nodes_[end].along_m);
      }
      i = std::max(end, i + 1);
    }
  }
  return text;
}

std::string Network::Text(const Spot& spot) const {
  return fmt::format("{}@{:g}", routes_[spot.route].name, spot.along_m);
}

Result<Way> Network::WayFound(const Spot& from, const Spot& to, const Found& found) const {
  if (found.cost < kClosedCosts) return WayOf(found.drives);
  const std::string ends = fmt::format("from {} to {}", Text(from), Text(to));
  if (found.cost < kNever) {
    return Fail(ErrorCode::kNotFound, "every way {} is closed; on the least closed: {}", ends,
                ClosedOn(found.drives));
  }
  return Fail(
      ErrorCode::kNotFound,
      "no way leads {}: routes are followed as they were taught, and no junctions lead there",
      ends);
}

Result<Way> Network::ShortestWay(const Place& from, const Place& to) const {
  const auto begin = Find(from);
  if (!begin) return tl::unexpected(begin.error());
  const auto end = Find(to);
  if (!end) return tl::unexpected(end.error());
  return WayFound(*begin, *end, Search(*begin, *end, {}));
}

Result<Way> Network::WayOn(const Place& from, const Place& to) const {
  const auto begin = Find(from);
  if (!begin) return tl::unexpected(begin.error());
  const auto end = Find(to);
  if (!end) return tl::unexpected(end.error());
  const WayOut out = OutOf(*begin);
  return WayFound(out.from, *end, Search(out.from, *end, out.open));
}

Network::WayOut Network::OutOf(const Spot& spot) const {
  const Index at = NodeAt(spot);
  const Open closed = ClosedAbout(at);
  const double begin_m = nodes_[closed.first].along_m;
  if (!nodes_[at].closed || spot.along_m <= begin_m) return {.open = {at, at}, .from = spot};
  if (spot.along_m <= begin_m + kBarelyIn_m) {
    return {.open = {closed.first, closed.first}, .from = {spot.route, begin_m}};
  }
  return {.open = closed, .from = spot};
}

std::optional<Condition> Network::FirstClosed(const Section& section) const {
  const auto begin = Find({section.route, section.from_m});
  if (!begin) return std::nullopt;
  const WayOut out = OutOf(*begin);
  const Index at = NodeAt(out.from);
  const Index last = NodeAt({begin->route, section.to_m});
  if (!section.backwards()) {
    for (Index i = std::max(at, out.open.end); i <= last; ++i) {
      if (nodes_[i].closed && nodes_[i].along_m < section.to_m) {
        return ClosedBetween(ClosedAbout(i));
      }
    }
    return std::nullopt;
  }
  for (Index i = out.open.first < out.open.end ? out.open.first : at + 1; i-- > last;) {
    if (nodes_[i].closed && nodes_[i].along_m < out.from.along_m) {
      return ClosedBetween(ClosedAbout(i));
    }
  }
  return std::nullopt;
}

std::optional<Condition> Network::ClosedAround(const Place& place) const {
  const auto spot = Find(place);
  if (!spot) return std::nullopt;
  const Open open = OutOf(*spot).open;
  return open.first < open.end ? std::optional(ClosedBetween(open)) : std::nullopt;
}

Network::Open Network::ClosedAbout(Index node) const {
  const auto is_closed = [&](Index i) {
    return nodes_[i].closed && nodes_[i].route == nodes_[node].route;
  };
  Open part{node, node};
  while (part.first > 0 && is_closed(part.first - 1)) --part.first;
  while (is_closed(part.end)) ++part.end;
  return part;
}

Condition Network::ClosedBetween(const Open& part) const {
  return {.route = routes_[nodes_[part.first].route].id,
          .from_m = nodes_[part.first].along_m,
          .to_m = nodes_[part.end].along_m,
          .closed = true};
}

}  // namespace trailcast::network
