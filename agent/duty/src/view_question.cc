#include "agent/duty/src/view_question.h"

#include <algorithm>
#include <utility>

namespace trailcast::agent {

ViewQuestion::ViewQuestion(const AgentId& self, std::uint64_t number, route::View view) {
  request_.client = self;
  request_.request = number;
  request_.query.view = std::move(view);
  // One route may have several similar places.
  request_.query.page_size = 3 * kMostRoutes;
}

void ViewQuestion::Hear(const exchange::Message& message) {
  const auto* reply = std::get_if<exchange::CatalogReply>(&message);
  const bool is_it = reply != nullptr && reply->client == request_.client &&
                     reply->request == request_.request && reply->error.empty();
  if (!is_it || answered()) return;
  routes_.emplace();
  for (const route::FoundPlace& place : reply->places) {
    const auto info = std::find_if(reply->page.routes.begin(), reply->page.routes.end(),
                                   [&](const auto& each) { return each.key == place.key; });
    const bool followed =
        info != reply->page.routes.end() && info->standing == route::Standing::kActive;
    const bool is_new =
        followed && std::find(routes_->begin(), routes_->end(), info->name) == routes_->end();
    if (is_new && routes_->size() < kMostRoutes) routes_->push_back(info->name);
  }
}

}  // namespace trailcast::agent
