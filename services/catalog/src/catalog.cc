#include "services/catalog/catalog.h"

#include "services/base/similar_names.h"
#include "services/exchange/bounds.h"

namespace trailcast::catalog {
namespace {

constexpr std::size_t kMaxSimilarNames = 10;
// A mistyped name is compared with so many names on either side of it in the alphabet.
constexpr std::size_t kNamesCompared = 500;

Result<std::vector<std::string>> SimilarNames(const std::string& wanted, store::RouteStore& store) {
  Result<std::vector<std::string>> near = store.NamesNear(wanted, kNamesCompared);
  if (!near) return near;
  return MostSimilar(wanted, std::move(*near), kMaxSimilarNames);
}

Result<void> Fill(exchange::CatalogReply& reply, const route::RouteQuery& query,
                  store::RouteStore& store) {
  if (auto possible = exchange::CheckQuery(query); !possible) return possible;
  if (!query.view.empty()) {
    return Fail(ErrorCode::kInvalidArgument, "view is given, and there is no index of views here");
  }
  Result<route::RoutePage> page = store.QueryRoutes(query);
  if (!page) return tl::unexpected(page.error());
  reply.page = std::move(*page);
  if (query.name.empty() || reply.page.total > 0) return {};
  Result<std::vector<std::string>> similar = SimilarNames(query.name, store);
  if (!similar) return tl::unexpected(similar.error());
  // The name itself is no suggestion: it is in use, but on routes that something else in the query
  // excludes.
  std::erase(*similar, query.name);
  reply.similar_names = std::move(*similar);
  return {};
}

}  // namespace

exchange::CatalogReply Answer(const exchange::CatalogRequest& request, const AgentId& server,
                              store::RouteStore& store) {
  exchange::CatalogReply reply{server, request.client, request.request, {}, {}, {}};
  if (auto filled = Fill(reply, request.query, store); !filled) {
    reply.page = {};
    reply.error = filled.error().message;
  }
  return reply;
}

}  // namespace trailcast::catalog
