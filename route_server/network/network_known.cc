// This part of NetworkRegistry knows which routes are meant and followed, and their names.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"
#include "route_server/routes/followable.h"
#include "services/exchange/route_finder.h"
#include "services/mission/orders.h"
#include "services/route/route_ref.h"

namespace trailcast::server {

using network::Condition;
using network::Goal;
using network::Junction;
using network::NamedPlace;
using network::Place;

Result<route::RouteInfo> NetworkRegistry::Meant(const std::string& words) const {
  const auto ref = route::ParseRouteRef(words);
  if (!ref) return tl::unexpected(ref.error());
  const auto routes = routes_.FindMeant(ref->route);
  if (!routes) return tl::unexpected(routes.error());
  auto found = exchange::ChooseMeant(ref->route, *routes, {.number = ref->revision});
  if (!found) return tl::unexpected(found.error());
  auto& meant = *found;
  if (!meant && routes->empty()) {
    return Fail(ErrorCode::kNotFound, "there is no route '{}'", words);
  }
  if (!meant) {
    return tl::unexpected(
        exchange::NotMeant("the server", ref->route, *routes, {.number = ref->revision}));
  }
  if (meant->state != route::RouteState::kComplete) {
    return Fail(ErrorCode::kNotFound, "route '{}' is not complete yet", words);
  }
  if (meant->length_m <= 0.0) {
    return Fail(ErrorCode::kInvalidArgument,
                "route '{}' was taught without odometry: no places on it are known in metres",
                words);
  }
  return *std::move(meant);
}

Result<Place> NetworkRegistry::Resolve(const Place& named) const {
  const auto meant = Meant(named.route);
  if (!meant) return tl::unexpected(meant.error());
  if (named.along_m > meant->length_m + kSame_m) {
    return Fail(ErrorCode::kInvalidArgument,
                "route '{}' is {:.2f} m long: there is no {:g} m on it", meant->name,
                meant->length_m, named.along_m);
  }
  return Place{IdOf(meant->key), ToCentimetre(named.along_m)};
}

Result<Place> NetworkRegistry::Resolve(const Goal& goal) const {
  if (goal.name.empty()) return Resolve(goal.place);
  const auto at = named_.find(goal.name);
  if (at != named_.end()) return at->second.place;
  return Fail(
      ErrorCode::kNotFound,
      "no place is called '{}': 'trailcast network' lists those that are, 'trailcast network "
      "name {} ROUTE@METRES' makes it one",
      goal.name, goal.name);
}

Result<std::vector<Place>> NetworkRegistry::PlacesOf(const Goal& goal) const {
  if (goal.name != mission::kHomeWord || named_.contains(goal.name)) {
    auto place = Resolve(goal);
    if (!place) return tl::unexpected(place.error());
    return std::vector{*std::move(place)};
  }
  std::vector<Place> homes;
  for (const auto& [name, named] : named_) {
    if (named.home) homes.push_back(named.place);
  }
  if (!homes.empty()) return homes;
  return Fail(ErrorCode::kNotFound,
              "no place is a home: 'trailcast network name NAME ROUTE@METRES home' makes it one");
}

Result<void> NetworkRegistry::Know(const std::set<RouteId>& asked) {
  const auto all_known = std::all_of(asked.begin(), asked.end(),
                                     [&](const RouteId& id) { return known_.contains(id); });
  if (network_ && all_known) return {};
  std::set<RouteId> wanted = asked;
  for (const Junction& junction : junctions_) {
    wanted.insert({KeyOf(junction.from.route).route, KeyOf(junction.to.route).route});
  }
  for (const Condition& condition : conditions_) wanted.insert(RouteId(condition.route));
  for (const auto& [name, named] : named_) wanted.insert(KeyOf(named.place.route).route);
  for (const store::KeptLane& kept : lanes_) {
    for (const network::Part& part : kept.lane.parts) wanted.insert(RouteId(part.route));
  }
  for (const store::ProposedJunction& each : proposed_) {
    if (each.verdict != store::ProposedJunction::Verdict::kNone) continue;
    const Junction& junction = each.proposal.junction;
    wanted.insert({KeyOf(junction.from.route).route, KeyOf(junction.to.route).route});
  }
  std::erase_if(known_, [&](const auto& each) { return !wanted.contains(each.first); });
  names_.clear();
  std::vector<network::Route> routes;
  for (const RouteId& id : wanted) {
    auto at = known_.find(id);
    if (at == known_.end()) {
      auto known = LookUp(id);
      if (!known) return tl::unexpected(known.error());
      at = known_.emplace(id, *std::move(known)).first;
    }
    if (const auto& followed = at->second.followed) {
      names_.insert(followed->name);
      routes.push_back({IdOf(followed->key), at->second.called, followed->length_m});
    }
  }
  std::vector<Junction> junctions;
  std::copy_if(
      junctions_.begin(), junctions_.end(), std::back_inserter(junctions),
      [&](const Junction& junction) { return IsUsed(junction.from) && IsUsed(junction.to); });
  std::vector<Condition> conditions = CostsOfPoor();
  for (Condition condition : conditions_) {
    const Known& known = known_.at(RouteId(condition.route));
    if (!known.followed) continue;
    condition.route = IdOf(known.followed->key);
    conditions.push_back(std::move(condition));
  }
  auto built = network::Network::Build(std::move(routes), junctions, conditions);
  if (!built) return tl::unexpected(built.error());
  network_ = *std::move(built);
  return {};
}

Result<NetworkRegistry::Known> NetworkRegistry::LookUp(const RouteId& route) const {
  const auto revisions = routes_.FindRevisions(route);
  if (!revisions) return tl::unexpected(revisions.error());
  const auto followed = std::find_if(revisions->begin(), revisions->end(), IsFollowable);
  Known known{.followed = {}, .called = route.value()};
  if (followed == revisions->end()) return known;
  known.followed = *followed;
  const auto namesakes = routes_.FindMeant(followed->name);
  if (!namesakes) return tl::unexpected(namesakes.error());
  if (exchange::FindRivals(*namesakes).empty()) known.called = followed->name;
  return known;
}

bool NetworkRegistry::IsUsed(const Place& place) const {
  const auto key = KeyOf(place.route);
  const auto at = known_.find(key.route);
  return at != known_.end() && at->second.followed && at->second.followed->key == key;
}

std::string NetworkRegistry::Called(const RouteId& route) const {
  const auto at = known_.find(route);
  return at == known_.end() ? route.value() : at->second.called;
}

Result<Place> NetworkRegistry::Called(const Place& place) const {
  const auto key = KeyOf(place.route);
  if (IsUsed(place)) return Place{Called(key.route), place.along_m};
  const auto info = routes_.FindRoute(key);
  if (!info) return tl::unexpected(info.error());
  if (!*info) return Place{key.route.value(), place.along_m};
  return Place{fmt::format("{}@{}", (*info)->name, (*info)->revision.value()), place.along_m};
}

Result<Junction> NetworkRegistry::Called(Junction junction) const {
  for (Place* place : {&junction.from, &junction.to}) {
    auto called = Called(*place);
    if (!called) return tl::unexpected(called.error());
    *place = *std::move(called);
  }
  return junction;
}

Result<NamedPlace> NetworkRegistry::Called(NamedPlace named) const {
  auto called = Called(named.place);
  if (!called) return tl::unexpected(called.error());
  named.place = *std::move(called);
  return named;
}

}  // namespace trailcast::server
