#include "services/vda5050/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "services/base/text.h"
#include "services/network/words.h"

namespace trailcast::vda5050 {
namespace {

using network::Edit;

constexpr std::size_t kLongestGoal = 96;  // of a mission's (mission::Going)

// The standard recommends ids without '@'.
std::string IdOf(const network::Place& place) {
  std::string id = network::ToText(place);
  id[id.rfind('@')] = ':';
  return id;
}

}  // namespace

Result<Graph> Graph::Read(const std::vector<std::string>& lines) {
  std::vector<network::Route> routes;
  std::vector<network::Junction> junctions;
  std::vector<network::Condition> conditions;
  std::vector<Named> named;
  std::vector<Named> others;
  std::set<std::string> names;
  for (const std::string& line : lines) {
    network::Listed listed = network::ParseListed(line);
    if (listed.route && names.insert(listed.route->name).second) {
      others.push_back({.place = {listed.route->name, 0.0}});
      others.push_back({.place = {listed.route->name, listed.route->length_m}});
      routes.push_back({.id = listed.route->name,
                        .name = listed.route->name,
                        .length_m = listed.route->length_m});
    }
    if (!listed.edit || !listed.used) continue;
    switch (listed.edit->kind) {
      case Edit::Kind::kJoin:
        others.push_back({.place = listed.edit->junction.from});
        others.push_back({.place = listed.edit->junction.to});
        junctions.push_back(listed.edit->junction);
        break;
      case Edit::Kind::kName:
        named.push_back({listed.edit->named.name, listed.edit->named.place});
        break;
      case Edit::Kind::kClose:
      case Edit::Kind::kBack:
      case Edit::Kind::kLimit:
        conditions.push_back(listed.edit->condition);
        break;
      default:
        break;
    }
  }
  // A route that junctions name may not be followed at present.
  std::erase_if(junctions, [&](const network::Junction& junction) {
    return !names.contains(junction.from.route) || !names.contains(junction.to.route);
  });
  auto built = network::Network::Build(std::move(routes), junctions, conditions);
  if (!built) return tl::unexpected(built.error());
  Graph graph(*std::move(built));
  for (Named& each : others) each.id = IdOf(each.place);
  graph.nodes_ = std::move(named);
  graph.nodes_.insert(graph.nodes_.end(), others.begin(), others.end());
  return graph;
}

Result<Graph::Node> Graph::Find(std::string_view id) const {
  const auto known =
      std::find_if(nodes_.begin(), nodes_.end(), [&](const Named& each) { return each.id == id; });
  if (known != nodes_.end()) {
    const bool is_name = id.find(':') == std::string_view::npos;
    return Node{is_name ? std::string(id) : network::ToText(known->place), known->place};
  }
  std::string word(id);
  if (const auto colon = word.rfind(':'); colon != std::string::npos) word[colon] = '@';
  const auto place = network::ParsePlace(word);
  const auto& routes = network_.routes();
  const auto route = std::find_if(routes.begin(), routes.end(), [&](const network::Route& each) {
    return place && each.id == place->route;
  });
  if (route == routes.end() || word.size() > kLongestGoal) {
    return Fail(
        ErrorCode::kNotFound,
        "there is no node '{}': a nodeId is a place's name, or ROUTE:METRES on a route that "
        "robots follow, as hall:2.5 ('trailcast network' lists both)",
        PlainText(id, 64));
  }
  if (place->along_m > route->length_m + network::kSame_m) {
    return Fail(ErrorCode::kNotFound, "there is no node '{}': route {} is {:.2f} m long",
                PlainText(id, 64), route->name, route->length_m);
  }
  return Node{std::move(word), *place};
}

Result<network::Way> Graph::WayBetween(const network::Place& from, const network::Place& to) const {
  return network_.ShortestWay(from, to);
}

bool Graph::IsOn(const network::Place& robot, const network::Place& node) const {
  if (robot.route == node.route && std::abs(robot.along_m - node.along_m) <= kOnNode_m) return true;
  for (const auto& way : {network_.ShortestWay(robot, node), network_.ShortestWay(node, robot)}) {
    if (way && way->length_m <= kOnNode_m) return true;
  }
  return false;
}

std::optional<std::string> Graph::NodeAt(const network::Place& robot) const {
  const Named* nearest = nullptr;
  double least_m = kOnNode_m;
  for (const Named& each : nodes_) {
    if (each.place.route != robot.route) continue;
    const double off_m = std::abs(each.place.along_m - robot.along_m);
    if (off_m > least_m || (nearest != nullptr && off_m == least_m)) continue;
    least_m = off_m;
    nearest = &each;
  }
  return nearest == nullptr ? std::nullopt : std::optional(nearest->id);
}

}  // namespace trailcast::vda5050
