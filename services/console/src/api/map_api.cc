#include "services/console/src/api/map_api.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <string>

#include "services/console/parameters.h"
#include "services/console/src/api/answers.h"
#include "services/console/src/geojson.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using httplib::Request;
using httplib::Response;

// After this, the caller is told how far the fetching is, and asks again.
constexpr std::chrono::milliseconds kLook{2000};
constexpr const char* kId = "([0-9a-f]{32})";

void Draw(Atlas& atlas, const Request& request, Response& response) {
  std::optional<TeachingId> teaching;
  if (request.has_param("teaching")) {
    const auto read = ReadTeaching(request.get_param_value("teaching"));
    if (!read) return Refuse(response, 400, "'teaching': " + read.error().message);
    teaching = *read;
  }
  const auto found = atlas.Find(RouteId(request.matches[1]), teaching, kLook);
  if (!found) return Refuse(response, found.error());
  if (found->shape) return Answer(response, 200, *found->shape);
  Answer(response, 202, program::OneLine({{"fetched", program::Rounded(found->fetched, 100.0)}}));
}

// Answers with the routes that are placed, or those of them that the request names. While some are
// being fetched, it tells what share is there.
void ExportPlaced(Atlas& atlas, Site* site, const Request& request, Response& response) {
  if (site == nullptr || !site->origin()) {
    return Refuse(response, 409,
                  "where the site is on the globe is not known: start the console with --site "
                  "FOLDER, whose site.json has \"origin\"");
  }
  Placements placements = site->placements();
  if (request.has_param("route")) {
    std::set<std::string> named;
    const auto [first, last] = request.params.equal_range("route");
    for (auto each = first; each != last; ++each) named.insert(each->second);
    std::erase_if(placements,
                  [&](const auto& placed) { return !named.contains(placed.first.value()); });
  }
  if (placements.size() > Atlas::kMostAsked) {
    return Refuse(
        response, 409,
        fmt::format("{} routes are placed, and {} at most are exported at once: name some, "
                    "as route=ID&route=ID",
                    placements.size(), Atlas::kMostAsked));
  }
  const auto until = std::chrono::steady_clock::now() + kLook;
  auto features = program::Json::array();
  double fetched = 0.0;
  for (const auto& [route, placement] : placements) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    const auto found =
        atlas.Find(route, std::nullopt, std::max(left, std::chrono::milliseconds(0)));
    if (!found && found.error().code == ErrorCode::kUnavailable) {
      return Refuse(response, found.error());
    }
    fetched += !found || found->shape ? 1.0 : found->fetched;
    if (!found || !found->shape) continue;  // it is deleted, or is still being taught
    if (auto feature = GeoJsonOf(route, *found->shape, placement, *site->origin())) {
      features.push_back(*std::move(feature));
    }
  }
  if (fetched < static_cast<double>(placements.size())) {
    const double share = fetched / static_cast<double>(placements.size());
    return Answer(response, 202, program::OneLine({{"fetched", program::Rounded(share, 100.0)}}));
  }
  response.set_content(
      program::OneLine({{"type", "FeatureCollection"}, {"features", std::move(features)}}),
      "application/geo+json");
}

void Place(Site* site, const Request& request, Response& response,
           const std::optional<Placement>& placement) {
  if (site == nullptr) {
    return Refuse(response, 409,
                  "nothing is kept of where routes lie: start the console with --site FOLDER");
  }
  const auto placed = site->Place(RouteId(request.matches[1]), placement);
  if (!placed) return Refuse(response, placed.error());
  Answer(response, 200, site->Body());
}

}  // namespace

void ServeMap(http::Server& server, Atlas& atlas, Site* site) {
  server.Get(
      fmt::format("/api/routes/{}/shape", kId),
      [&atlas](const Request& request, Response& response) { Draw(atlas, request, response); });
  server.Get("/api/site", [site](const Request&, Response& response) {
    Answer(response, 200, site != nullptr ? site->Body() : NoSiteBody());
  });
  server.Get("/api/site/geojson", [&atlas, site](const Request& request, Response& response) {
    ExportPlaced(atlas, site, request, response);
  });
  server.Get("/api/site/plan", [site](const Request&, Response& response) {
    if (site == nullptr || !site->plan()) return Refuse(response, 404, "there is no floor plan");
    const Site::Plan& plan = *site->plan();
    response.set_header("Cache-Control", "private, max-age=300");
    response.set_content_provider(
        plan.bytes.size(), plan.type,
        [&plan](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
          return sink.write(plan.bytes.data() + offset, length);
        });
  });
  const std::string placement = fmt::format("/api/site/placements/{}", kId);
  server.Put(placement, [site](const Request& request, Response& response) {
    const auto read = ReadPlacement(request.body);
    if (!read) return Refuse(response, read.error());
    Place(site, request, response, *read);
  });
  server.Delete(placement, [site](const Request& request, Response& response) {
    Place(site, request, response, std::nullopt);
  });
}

}  // namespace trailcast::console
