// This part of NetworkRegistry finds the routes that pass at a place, by junctions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"
#include "services/network/passing.h"

namespace trailcast::server {
namespace {

using network::Junction;
using network::Passing;
using network::Place;

// Returns the other route's metres beside `place`, by a junction from `here` to `there` of routes
// that share `shared_m`. It is nothing if they do not run together there, or the junction is not on
// that route.
std::optional<double> AlongOther(const Place& place, const Place& here, const Place& there,
                                 double shared_m) {
  constexpr double kLeast_m = NetworkRegistry::kSameMeeting_m;
  const double into_m = IntoShared_m(shared_m);
  const double on_m = place.along_m - here.along_m;
  if (here.route != place.route || on_m < -std::max(into_m, kLeast_m)) return std::nullopt;
  if (on_m > std::max(shared_m - into_m, kLeast_m)) return std::nullopt;
  return there.along_m + on_m;
}

}  // namespace

void NetworkRegistry::AddPassing(const Place& place, const Junction& junction, double shared_m,
                                 std::optional<double> confidence,
                                 std::vector<Passing>& found) const {
  for (const auto& [here, there] :
       {std::pair(&junction.from, &junction.to), std::pair(&junction.to, &junction.from)}) {
    const auto along_m = AlongOther(place, *here, *there, shared_m);
    if (!along_m) continue;
    const double length_m = known_.at(KeyOf(there->route).route).followed->length_m;
    const Place at{there->route, ToCentimetre(std::clamp(*along_m, 0.0, length_m))};
    const bool is_found = std::any_of(found.begin(), found.end(), [&](const Passing& each) {
      return each.at.route == at.route && std::abs(each.at.along_m - at.along_m) <= kSameMeeting_m;
    });
    if (!is_found) found.push_back({at, junction, confidence});
  }
}

double NetworkRegistry::SharedBy(const Junction& junction) const {
  const auto proposed =
      std::find_if(proposed_.begin(), proposed_.end(), [&](const store::ProposedJunction& each) {
        return each.proposal.junction.from == junction.from &&
               each.proposal.junction.to == junction.to;
      });
  return proposed == proposed_.end() ? 0.0 : proposed->length_m;
}

Result<std::vector<Place>> NetworkRegistry::AlsoAt(const Place& place) {
  if (auto known = Know({KeyOf(place.route).route}); !known) return tl::unexpected(known.error());
  std::vector<Passing> found;
  for (const Junction& junction : junctions_) {
    const double shared_m = SharedBy(junction);
    const bool is_measured = shared_m > 0.0 && IsUsed(junction.from) && IsUsed(junction.to);
    if (is_measured) AddPassing(place, junction, shared_m, {}, found);
  }
  std::vector<Place> also;
  for (const Passing& each : found) also.push_back(each.at);
  return also;
}

Result<std::vector<std::string>> NetworkRegistry::WhatPasses(const network::Goal& goal) {
  const auto place = Resolve(goal);
  if (!place) return tl::unexpected(place.error());
  if (auto known = Know({KeyOf(place->route).route}); !known) {
    return tl::unexpected(known.error());
  }
  const auto called = Called(*place);
  if (!called) return tl::unexpected(called.error());
  if (!IsUsed(*place)) {
    return Fail(ErrorCode::kNotFound, "{} is on a revision that robots do not follow",
                network::ToText(*called));
  }

  std::vector<Passing> found;
  for (const Junction& junction : junctions_) {
    if (junction.from.route != place->route && junction.to.route != place->route) continue;
    if (IsUsed(junction.from) && IsUsed(junction.to)) {
      AddPassing(*place, junction, SharedBy(junction), {}, found);
    }
  }
  for (const std::size_t each : Open()) {
    const network::Proposal& proposal = proposed_[each].proposal;
    AddPassing(*place, proposal.junction, proposed_[each].length_m, proposal.confidence, found);
  }

  std::vector<std::string> lines{network::AtPlace(*called)};
  for (const Passing& each : found) {
    const auto at = Called(each.at);
    if (!at) return tl::unexpected(at.error());
    const auto junction = Called(each.junction);
    if (!junction) return tl::unexpected(junction.error());
    lines.push_back(network::ToText(Passing{*at, *junction, each.confidence}));
  }
  return lines;
}

}  // namespace trailcast::server
