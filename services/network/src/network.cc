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

// A robot that has arrived may say that it stands a little beyond the end.
constexpr double kBeyondEnd_m = 0.5;
constexpr double kNever = std::numeric_limits<double>::infinity();
// What is closed is searched last, so that one search tells what way there is, and what bars it.
// Above what any way costs.
constexpr double kClosedCosts = 1e15;

}  // namespace

bool GoesOn(const Stretch& before, const Stretch& next) {
  return before.route == next.route && std::abs(before.to_m - next.from_m) <= kSame_m;
}

double LengthOf(std::span<const Stretch> stretches) {
  double length_m = 0.0;
  for (const Stretch& stretch : stretches) length_m += stretch.to_m - stretch.from_m;
  return length_m;
}

Result<Network> Network::Build(std::vector<Route> routes, const std::vector<Joint>& joints,
                               std::span<const Condition> conditions) {
  Network network;
  network.routes_ = std::move(routes);
  for (Index i = 0; i < network.routes_.size(); ++i) {
    if (!network.by_id_.emplace(network.routes_[i].id, i).second) {
      return Fail(ErrorCode::kInvalidArgument, "two routes with the id {}", network.routes_[i].id);
    }
  }
  for (const Joint& joint : joints) {
    for (const Place* place : {&joint.from, &joint.to}) {
      if (const auto found = network.Find(*place); !found) {
        return Fail(ErrorCode::kInvalidArgument, "a joint: {}", found.error().message);
      }
    }
  }
  network.PlaceNodes(joints, conditions);
  network.Weigh(conditions);
  network.Link(joints);
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

void Network::PlaceNodes(const std::vector<Joint>& joints, std::span<const Condition> conditions) {
  const auto add = [this](const Spot& spot) {
    nodes_.push_back({.route = spot.route, .along_m = spot.along_m});
  };
  for (Index i = 0; i < routes_.size(); ++i) {
    add({i, 0.0});
    add({i, routes_[i].length_m});
  }
  for (const Joint& joint : joints) {
    add(*Find(joint.from));
    add(*Find(joint.to));
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
      nodes_[i].speed = std::min(nodes_[i].speed, condition.speed);
      nodes_[i].cost *= condition.cost;
    }
  }
}

void Network::Link(const std::vector<Joint>& joints) {
  std::vector<std::pair<Index, Index>> links;
  for (const Joint& joint : joints) {
    const Index from = NodeAt(*Find(joint.from));
    const Index to = NodeAt(*Find(joint.to));
    links.emplace_back(from, to);
    if (joint.both) links.emplace_back(to, from);
  }
  std::sort(links.begin(), links.end());
  for (const auto& [from, to] : links) leaps_.push_back(to);
  auto next = links.cbegin();
  for (Index i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    next = std::lower_bound(next, links.cend(), std::pair(i, Index{0}));
    const bool is_last = i + 1 == nodes_.size() || nodes_[i + 1].route != node.route;
    exits_.push_back({.ahead = is_last ? kNever : Costs(i, node.along_m, nodes_[i + 1].along_m),
                      .first_leap = static_cast<Index>(next - links.cbegin())});
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

// Dijkstra's, from node to node; that of the goal is left on the way to it.
Network::Found Network::Search(const Spot& from, const Spot& to, Index open_until) const {
  constexpr Index kNone = std::numeric_limits<Index>::max();
  struct Reached {
    double cost = kNever;
    Index before = kNone;  // the node before it
    bool leapt = false;    // over a joint
  };
  std::vector<Reached> reached(nodes_.size());
  using Due = std::pair<double, Index>;
  std::priority_queue<Due, std::vector<Due>, std::greater<>> due;
  const auto reach = [&](Index node, double cost, Index before, bool leapt) {
    if (!(cost < reached[node].cost)) return;
    reached[node] = {cost, before, leapt};
    due.emplace(cost, node);
  };

  const Index goal = NodeAt(to);
  const Index begin = NodeAt(from);
  const auto costs = [&](Index node, double from_m, double to_m) {
    return Costs(node, from_m, to_m, node >= begin && node < open_until);
  };
  double best = kNever;
  if (begin == goal && from.along_m <= to.along_m) best = costs(begin, from.along_m, to.along_m);
  bool over_goal = false;
  if (nodes_[begin].along_m >= from.along_m) {
    reach(begin, 0.0, kNone, false);
  } else {
    reach(begin + 1, costs(begin, from.along_m, nodes_[begin + 1].along_m), kNone, false);
  }
  while (!due.empty() && due.top().first < best) {
    const auto [cost, node] = due.top();
    due.pop();
    if (cost > reached[node].cost) continue;
    if (node == goal) {
      const double all = cost + costs(node, nodes_[node].along_m, to.along_m);
      if (all < best) {
        best = all;
        over_goal = true;
      }
    }
    const Exits& exits = exits_[node];
    if (exits.ahead < kNever) {
      const bool is_own = node >= begin && node < open_until;
      const double ahead =
          is_own ? costs(node, nodes_[node].along_m, nodes_[node + 1].along_m) : exits.ahead;
      reach(node + 1, cost + ahead, node, false);
    }
    for (Index i = exits.first_leap; i < exits_[node + 1].first_leap; ++i) {
      reach(leaps_[i], cost + kChangeCosts_m, node, true);
    }
  }
  if (!over_goal) {
    return {.cost = best, .drives = {{from.route, from.along_m, to.along_m}}};
  }
  std::vector<Drive> drives{{to.route, nodes_[goal].along_m, to.along_m}};
  for (Index node = goal; reached[node].before != kNone; node = reached[node].before) {
    const Node& before = nodes_[reached[node].before];
    if (reached[node].leapt) {
      drives.push_back({before.route, before.along_m, before.along_m});
    } else {
      drives.back().from_m = before.along_m;
    }
  }
  drives.back().from_m = from.along_m;
  std::reverse(drives.begin(), drives.end());
  return {.cost = best, .drives = std::move(drives)};
}

Way Network::WayOf(const std::vector<Drive>& drives) const {
  Way way;
  for (const Drive& drive : drives) {
    bool goes_on = false;
    double at_m = drive.from_m;
    for (Index i = NodeAt({drive.route, drive.from_m}); at_m < drive.to_m; ++i) {
      const double end_m = std::min(nodes_[i + 1].along_m, drive.to_m);
      if (goes_on && way.stretches.back().speed == nodes_[i].speed) {
        way.stretches.back().to_m = end_m;
      } else {
        way.stretches.push_back({routes_[drive.route].id, at_m, end_m, nodes_[i].speed});
        goes_on = true;
      }
      at_m = end_m;
    }
    way.length_m += drive.to_m - drive.from_m;
  }
  return way;
}

std::string Network::ClosedOn(const std::vector<Drive>& drives) const {
  std::string text;
  for (const Drive& drive : drives) {
    Index i = NodeAt({drive.route, drive.from_m});
    while (i + 1 < nodes_.size() && nodes_[i].route == drive.route &&
           nodes_[i].along_m < drive.to_m) {
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
  return Fail(ErrorCode::kNotFound,
              "no way leads {}: routes are followed as they were taught, and no joints lead there",
              ends);
}

Result<Way> Network::ShortestWay(const Place& from, const Place& to) const {
  const auto begin = Find(from);
  if (!begin) return tl::unexpected(begin.error());
  const auto end = Find(to);
  if (!end) return tl::unexpected(end.error());
  return WayFound(*begin, *end, Search(*begin, *end, 0));
}

Result<Way> Network::WayOn(const Place& from, const Place& to) const {
  const auto begin = Find(from);
  if (!begin) return tl::unexpected(begin.error());
  const auto end = Find(to);
  if (!end) return tl::unexpected(end.error());
  const WayOut out = OutOf(*begin);
  return WayFound(out.from, *end, Search(out.from, *end, out.open_until));
}

Network::WayOut Network::OutOf(const Spot& spot) const {
  const Index at = NodeAt(spot);
  Index first = at;
  while (first > 0 && nodes_[first - 1].closed && nodes_[first - 1].route == spot.route) --first;
  const bool is_in = nodes_[at].closed && spot.along_m > nodes_[first].along_m;
  if (!is_in) return {.open_until = at, .from = spot};
  if (spot.along_m <= nodes_[first].along_m + kBarelyIn_m) {
    return {.open_until = first, .from = {spot.route, nodes_[first].along_m}};
  }
  Index end = at;
  while (nodes_[end].closed) ++end;
  return {.open_until = end, .from = spot};
}

std::optional<Condition> Network::FirstClosed(const Stretch& stretch) const {
  const auto begin = Find({stretch.route, stretch.from_m});
  if (!begin) return std::nullopt;
  const WayOut out = OutOf(*begin);
  Index i = std::max(NodeAt(out.from), out.open_until);
  while (i + 1 < nodes_.size() && nodes_[i].route == begin->route &&
         nodes_[i].along_m < stretch.to_m) {
    Index end = i;
    while (nodes_[end].closed) ++end;
    if (end > i) return ClosedBetween(i, end);
    ++i;
  }
  return std::nullopt;
}

std::optional<Condition> Network::ClosedAround(const Place& place) const {
  const auto spot = Find(place);
  if (!spot) return std::nullopt;
  const Index at = NodeAt(*spot);
  const Index end = OutOf(*spot).open_until;
  if (end <= at) return std::nullopt;
  Index first = at;
  while (first > 0 && nodes_[first - 1].closed && nodes_[first - 1].route == spot->route) --first;
  return ClosedBetween(first, end);
}

Condition Network::ClosedBetween(Index first, Index end) const {
  return {.route = routes_[nodes_[first].route].id,
          .from_m = nodes_[first].along_m,
          .to_m = nodes_[end].along_m,
          .closed = true};
}

}  // namespace trailcast::network
