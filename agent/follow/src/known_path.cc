#include "agent/follow/known_path.h"

#include <fmt/format.h>

#include "services/route/backwards.h"

namespace trailcast::agent {
namespace {

HowToFollow Possible(HowToFollow how) {
  if (how.backwards) how.session.take_experience = false;  // it sees each segment from its end
  return how;
}

}  // namespace

KnownPath::KnownPath(const HowToFollow& how)
    : how_(Possible(how)), terrain_(how.terrain), comfort_(how.comfort) {}

Result<void> KnownPath::Take(Feed item) {
  if (const auto* route = std::get_if<route::RouteInfo>(&item)) {
    Begin(*route);
  } else if (const auto* left = std::get_if<LeftAt>(&item)) {
    if (!left_ && segments_ == 0) GoOnFrom(*left);
  } else if (auto* segment = std::get_if<route::Segment>(&item)) {
    if (!superseded_.empty() || complete_) return {};
    if (!how_.backwards) return Add(std::move(*segment));
    length_m_ += segment->length_m;
    to_turn_.push_back(std::move(*segment));
  } else if (std::get_if<RouteComplete>(&item) != nullptr) {
    return complete_ ? Result<void>() : Complete();
  } else if (auto* error = std::get_if<Error>(&item)) {
    return tl::unexpected(*error);
  }
  return {};
}

void KnownPath::Begin(const route::RouteInfo& route) {
  if (!session_) {
    session_.emplace(how_.session, route);
    route_ = route;
  } else if (route.key != route_->key) {
    superseded_ =
        fmt::format("robots follow revision {} of '{}' now, and it drives along revision {}",
                    route.revision.value(), route.name, route_->revision.value());
  }
}

void KnownPath::GoOnFrom(LeftAt left) {
  left_ = left;
  if (!how_.backwards) session_->GoOnFrom(left);
}

Result<void> KnownPath::Add(route::Segment segment) {
  if (segment.index.value() < segments_) return {};
  terrain_.Add(segment);
  comfort_.Add(segment);
  if (auto added = session_->AddSegment(std::move(segment)); !added) return added;
  ++segments_;
  return {};
}

Result<void> KnownPath::Complete() {
  if (how_.backwards) {
    auto turned = route::DrivenBackwards(std::exchange(to_turn_, {}));
    if (!turned) return tl::unexpected(turned.error());
    if (left_) {
      left_->along_m = OfRoute(left_->along_m);
      session_->GoOnFrom(*left_);
    }
    for (route::Segment& segment : *turned) {
      if (auto added = Add(std::move(segment)); !added) return added;
    }
  }
  session_->MarkComplete();
  complete_ = true;
  return {};
}

bool KnownPath::AwaitsAll() const {
  const bool will_be = route_ && route_->state == route::RouteState::kComplete;
  return terrain_.any() && will_be && !complete_;
}

std::optional<std::string> KnownPath::Refusal() const {
  return terrain_.Refusal(left_ ? left_->along_m : 0.0);
}

ReplayStep KnownPath::OfRoute(ReplayStep step) const {
  if (!how_.backwards || segments_ == 0) return step;
  step.segment = SegmentIndex(segments_ - 1 - step.segment.value());
  step.fraction = 1.0 - step.fraction;
  if (step.along_m) step.along_m = OfRoute(*step.along_m);
  return step;
}

}  // namespace trailcast::agent
