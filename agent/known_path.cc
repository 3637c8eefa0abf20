#include "agent/known_path.h"

#include <fmt/format.h>

#include <utility>

namespace trailcast::agent {

Result<void> KnownPath::Take(Feed item) {
  if (const auto* route = std::get_if<route::RouteInfo>(&item)) {
    Begin(*route);
  } else if (const auto* left = std::get_if<LeftAt>(&item)) {
    if (!left_ && segments_ == 0) {
      session_->GoOnFrom(*left);
      left_ = *left;
    }
  } else if (auto* segment = std::get_if<route::Segment>(&item)) {
    return Add(std::move(*segment));
  } else if (std::get_if<RouteComplete>(&item) != nullptr) {
    if (!complete_) session_->MarkComplete();
    complete_ = true;
  } else if (auto* error = std::get_if<Error>(&item)) {
    return tl::unexpected(*error);
  }
  return {};
}

void KnownPath::Begin(const route::RouteInfo& route) {
  if (!session_) {
    session_.emplace(method_, route);
    route_ = route;
  } else if (route.key != route_->key) {
    superseded_ =
        fmt::format("robots follow revision {} of '{}' now, and it drives along revision {}",
                    route.revision.value(), route.name, route_->revision.value());
  }
}

Result<void> KnownPath::Add(route::Segment segment) {
  if (!superseded_.empty() || segment.index.value() < segments_) return {};
  terrain_.Add(segment);
  comfort_.Add(segment);
  if (auto added = session_->AddSegment(std::move(segment)); !added) return added;
  ++segments_;
  return {};
}

bool KnownPath::AwaitsAll() const {
  return terrain_.any() && route_ && route_->state == route::RouteState::kComplete && !complete_;
}

std::optional<std::string> KnownPath::Refusal() const {
  return terrain_.Refusal(left_ ? left_->along_m : 0.0);
}

}  // namespace trailcast::agent
