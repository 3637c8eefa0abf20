#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/fleet/operator_peer.h"
#include "services/fleet/routes/transfer.h"
#include "services/route/route.h"
#include "services/route/terrain_profile.h"
#include "services/view/weak_places.h"

namespace trailcast::fleet {

// This is what a route's segments tell of it that its catalog entry does not.
struct RouteStudy {
  std::vector<view::WeakPlace> weak_places;
  std::vector<route::TerrainSection> terrain{};
};
using RouteStudies = std::map<route::RouteKey, RouteStudy>;

// Fetches a complete route to study it. Errors are FetchInOrder's, and kCorrupt for a segment that
// cannot be read.
[[nodiscard]] Result<RouteStudy> StudyRoute(OperatorPeer& peer, const route::RouteInfo& info,
                                            const TransferWatch& watch);

// Returns, for people, where followers may be lost and why, one line for each place, or that there
// is no such place.
[[nodiscard]] std::string WeakPlacesText(const route::RouteInfo& info, const RouteStudy& study);
// Returns an array for programs.
[[nodiscard]] nlohmann::ordered_json WeakPlacesJson(const route::RouteInfo& info,
                                                    const RouteStudy& study);

// These return the same for the ground: one line for each section, or that nothing is known of it.
[[nodiscard]] std::string GroundText(const route::RouteInfo& info, const RouteStudy& study);
[[nodiscard]] nlohmann::ordered_json GroundJson(const route::RouteInfo& info,
                                                const RouteStudy& study);

}  // namespace trailcast::fleet
