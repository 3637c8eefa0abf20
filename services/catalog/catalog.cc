#include "services/catalog/catalog.h"

#include "services/catalog/similar_names.h"

namespace trailcast::catalog {
namespace {

constexpr std::size_t kMaxSimilarNames = 10;

Result<std::vector<std::string>> SimilarNames(const std::string& wanted, store::RouteStore& store) {
  const Result<std::vector<route::RouteInfo>> routes = store.ListRoutes();
  if (!routes) return tl::unexpected(routes.error());
  std::vector<std::string> names;
  names.reserve(routes->size());
  for (const route::RouteInfo& info : *routes) names.push_back(info.name);
  return MostSimilar(wanted, std::move(names), kMaxSimilarNames);
}

}  // namespace

exchange::CatalogReply Answer(const exchange::CatalogRequest& request, const AgentId& server,
                              store::RouteStore& store) {
  exchange::CatalogReply reply{server, request.client, request.request, {}, {}, {}};
  if (!request.name.empty() && !IsValidName(request.name)) {
    reply.error = fmt::format(
        "name '{:.64}' is no route's: expected 1 to 64 of [A-Za-z0-9_.-], or nothing for every "
        "route",
        request.name);
    return reply;
  }
  Result<std::vector<route::RouteInfo>> routes =
      request.name.empty() ? store.ListRoutes() : store.FindRoutesByName(request.name);
  if (!routes) {
    reply.error = routes.error().message;
    return reply;
  }
  reply.routes = std::move(*routes);
  if (!reply.routes.empty() || request.name.empty()) return reply;
  Result<std::vector<std::string>> similar = SimilarNames(request.name, store);
  if (similar) {
    reply.similar_names = std::move(*similar);
  } else {
    reply.error = similar.error().message;
  }
  return reply;
}

}  // namespace trailcast::catalog
