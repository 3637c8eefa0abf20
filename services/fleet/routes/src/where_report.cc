#include "services/fleet/routes/where_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/program/json.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::fleet {
namespace {

struct Found {
  const route::FoundPlace& place;
  const route::RouteInfo& route;
};

// Returns the places with their routes, as far as the reply has a route for each place.
std::vector<Found> PlacesIn(const exchange::CatalogReply& reply) {
  std::vector<Found> found;
  const std::size_t count = std::min(reply.places.size(), reply.page.routes.size());
  for (std::size_t i = 0; i < count; ++i) {
    found.push_back({reply.places[i], reply.page.routes[i]});
  }
  return found;
}

}  // namespace

std::string WhereText(const exchange::CatalogReply& reply) {
  std::string text;
  const route::ShortIds ids(reply.page.routes);
  for (const auto& [place, route] : PlacesIn(reply)) {
    const bool is_followed = route.standing == route::Standing::kActive;
    text +=
        fmt::format("route {} {}{}, segment {} of {}, score {:.2f}\n", route.name, ids.Of(route),
                    is_followed ? "" : fmt::format(" ({})", route::StateText(route)),
                    place.segment.value(), route.segment_count, place.score);
  }
  const route::ViewCoverage& searched = reply.coverage;
  if (text.empty()) {
    text = fmt::format("none of the {} segments looks like this\n", searched.segments_indexed);
  }
  if (searched.segments_indexed < searched.segments_stored || searched.routes_unseen > 0) {
    text +=
        fmt::format("searched {} of {} segments, and none of {} further routes\n",
                    searched.segments_indexed, searched.segments_stored, searched.routes_unseen);
  }
  return text;
}

program::Json WhereJson(const exchange::CatalogReply& reply) {
  auto places = program::Json::array();
  for (const auto& [place, route] : PlacesIn(reply)) {
    places.push_back({{"name", route.name},
                      {"route", place.key.route.value()},
                      {"revision", route.revision.value()},
                      {"state", route::StateText(route)},
                      {"segment", place.segment.value()},
                      {"segments", route.segment_count},
                      {"score", program::Rounded(place.score, 1000.0)}});
  }
  const route::ViewCoverage& searched = reply.coverage;
  return {{"places", std::move(places)},
          {"segments_indexed", searched.segments_indexed},
          {"segments_stored", searched.segments_stored},
          {"routes_unseen", searched.routes_unseen}};
}

}  // namespace trailcast::fleet
