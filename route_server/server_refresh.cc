// This part of the server handles revisions with which robots refresh the followed one.
#include <spdlog/spdlog.h>

#include "route_server/server.h"
#include "services/route/labels.h"

namespace trailcast::server {
namespace {

// In each round of the server.
constexpr std::chrono::milliseconds kTurn{3};

}  // namespace

void Server::LookAtRefreshed() {
  const auto until = std::chrono::steady_clock::now() + kTurn;
  Result<bool> more = true;
  while (more && *more && std::chrono::steady_clock::now() < until) more = refreshes_.Step();
  if (!more) spdlog::warn("a refreshed revision stays staged: {}", more.error().message);
  for (const RefreshWatch::Judged& judged : refreshes_.TakeJudged()) {
    const std::string which = route::Describe(judged.info);
    if (!judged.why_not.empty()) {
      spdlog::warn("{} stays staged, though it asks for no look: {}", which, judged.why_not);
      continue;
    }
    spdlog::info("{} takes the place of the one that it refreshes", which);
    ReceiveRequest(exchange::RouteEditRequest{.client = presence_.status().agent,
                                              .request = refresh_request_++,
                                              .edit = {.route = judged.info.key.route.value(),
                                                       .revision = judged.info.revision.value()}});
  }
}

}  // namespace trailcast::server
