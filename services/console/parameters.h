#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/result.h"
#include "services/console/network_query.h"
#include "services/console/runs_query.h"
#include "services/mission/mission.h"
#include "services/photos/photo.h"
#include "services/route/route_query.h"

namespace trailcast::console {

// These read parameters of requests, as openapi.yaml has them. A parameter may be anything. Errors
// are kInvalidArgument and say what was expected.

// These are the decoded parameters behind an address's question mark.
using Parameters = std::multimap<std::string, std::string>;
// Reads the parameters of GET /api/routes.
[[nodiscard]] Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters);
// These read the parameters of GET /api/missions and of GET /api/commands.
[[nodiscard]] Result<mission::Query> ReadMissionQuery(const Parameters& parameters);
[[nodiscard]] Result<mission::Query> ReadCommandQuery(const Parameters& parameters);

// This asks for the changes since then, of these routes alone if there are any, by names or whole
// ids.
struct ChangesQuery {
  std::int64_t since_unix_ms = 0;
  std::vector<std::string> routes{};
  std::uint32_t limit = 100;
};
// Reads the parameters of GET /api/changes. `since` is in a person's words (base/local_time.h).
[[nodiscard]] Result<ChangesQuery> ReadChangesQuery(const Parameters& parameters,
                                                    std::int64_t now_unix_ms);

// Reads the parameters of GET /api/runs.
[[nodiscard]] Result<RunsQuery> ReadRunsQuery(const Parameters& parameters);

// This asks for a page of photos.
struct PhotosQuery {
  photos::PhotoQuery of{};
  std::uint32_t first = 0;  // photo of the page
};
// Reads the parameters of GET /api/photos.
[[nodiscard]] Result<PhotosQuery> ReadPhotosQuery(const Parameters& parameters);

// Reads the parameters of GET /api/network.
[[nodiscard]] Result<NetworkQuery> ReadNetworkQuery(const Parameters& parameters);
// Reads the parameters of GET /api/network/way into a server's words (network/words.h).
[[nodiscard]] Result<std::string> ReadWayQuestion(const Parameters& parameters);

// Reads the number of a teaching in hexadecimal digits.
[[nodiscard]] Result<TeachingId> ReadTeaching(const std::string& text);

}  // namespace trailcast::console
