#include "agent/link/src/fetcher_for.h"

#include "services/route/digest.h"

namespace trailcast::agent {

Result<exchange::RouteFetcher> FetcherFor(const AgentId& self, const route::RouteKey& key,
                                          const std::vector<exchange::RouteFetcher::Held>& held,
                                          store::RouteStore& store,
                                          exchange::RouteFetcher::Time now) {
  auto others = store.FindRevisions(key.route);
  if (!others) return tl::unexpected(others.error());
  std::erase_if(*others, [&](const route::RouteInfo& info) { return info.key == key; });
  exchange::RouteFetcherOptions options;
  if (!others->empty()) {
    options.own_content = [&store](const route::Digest& digest) {
      return store.FindContent(digest).value_or(std::nullopt);
    };
  }
  return exchange::RouteFetcher(self, key, held,
                                exchange::Integrity{route::CheckDigest, route::ManifestDigest}, now,
                                std::move(options));
}

}  // namespace trailcast::agent
