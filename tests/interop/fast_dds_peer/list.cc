#include "commands.h"
#include "trailcastPubSubTypes.h"

namespace peer {

namespace wire = trailcast::wire;

std::vector<wire::CatalogRoute> List(Bus& bus, const std::string& name) {
  constexpr std::uint32_t kPage = 100;
  Outlet<wire::CatalogRequestPubSubType> requests(bus, "trailcast/catalog_requests", kAsked);
  Inlet<wire::CatalogReplyPubSubType> replies(bus, "trailcast/catalog_replies", kAsked);
  wire::CatalogRequest request;
  request.client(kName);
  request.request(static_cast<std::uint64_t>(Clock::now().time_since_epoch().count()));
  request.query().name(name);
  request.query().page_size(kPage);
  std::vector<wire::CatalogRoute> routes;
  bool answered = false;
  const auto is_ours = [&](const wire::CatalogReply& reply) {
    return reply.client() == kName && reply.request() == request.request();
  };
  while (!answered || !request.query().cursor().empty()) {
    answered = false;
    Until(
        bus, "an answer from the catalog", [&] { requests.Put(request); },
        [&] {
          for (const wire::CatalogReply& reply : replies.Take()) {
            if (!is_ours(reply) || answered) continue;
            if (!reply.error().empty()) throw std::runtime_error("the server: " + reply.error());
            routes.insert(routes.end(), reply.routes().begin(), reply.routes().end());
            request.query().cursor(reply.next());
            answered = true;
          }
          return answered;
        });
    request.request(request.request() + 1);
  }
  return routes;
}

}  // namespace peer
