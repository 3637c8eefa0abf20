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
#include "services/route/route_query.h"

namespace trailcast::console {

// Parameters of requests, as openapi.yaml has them. What is read may be anything: kInvalidArgument
// says what was expected.

// What comes behind the question mark of an address, decoded.
using Parameters = std::multimap<std::string, std::string>;
// Of GET /api/routes.
[[nodiscard]] Result<route::RouteQuery> ReadRouteQuery(const Parameters& parameters);
// Of GET /api/missions and of GET /api/commands.
[[nodiscard]] Result<mission::Query> ReadMissionQuery(const Parameters& parameters);
[[nodiscard]] Result<mission::Query> ReadCommandQuery(const Parameters& parameters);

// What was changed then or later, of these routes alone if there are any: names or whole ids.
struct ChangesQuery {
  std::int64_t since_unix_ms = 0;
  std::vector<std::string> routes{};
  std::uint32_t limit = 100;
};
// Of GET /api/changes; `since` is what a person says (base/local_time.h).
[[nodiscard]] Result<ChangesQuery> ReadChangesQuery(const Parameters& parameters,
                                                    std::int64_t now_unix_ms);

// Of GET /api/runs.
[[nodiscard]] Result<RunsQuery> ReadRunsQuery(const Parameters& parameters);

// Of GET /api/network.
[[nodiscard]] Result<NetworkQuery> ReadNetworkQuery(const Parameters& parameters);
// Of GET /api/network/way, in a server's words (network/words.h).
[[nodiscard]] Result<std::string> ReadWayQuestion(const Parameters& parameters);

// Of which teaching, in hexadecimal digits.
[[nodiscard]] Result<TeachingId> ReadTeaching(const std::string& text);

}  // namespace trailcast::console
