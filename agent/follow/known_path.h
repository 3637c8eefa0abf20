#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/follow/comfort.h"
#include "agent/follow/terrain_check.h"
#include "agent/link/feed.h"
#include "agent/session/replay_session.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// How a robot is to drive along a route, whichever that is.
struct HowToFollow {
  ReplayMethodOptions session;
  // What ground the robot can drive: with limits, and a route that is complete, it looks at all of
  // it before it moves; of one that is still being taught it knows no more than has come.
  TerrainLimits terrain{};
  bool comfort = false;  // it drives slower where the ground is rough
  // In reverse gear, from the route's end to its beginning, at route::kBackwardsPace; once all of
  // it is known.
  bool backwards = false;
};

// What a control loop knows of the route that it follows, as far as its link has fed it. The
// session goes by metres and segments as they are driven; what it says of the route is put in the
// route's.
class KnownPath {
 public:
  explicit KnownPath(const HowToFollow& how);

  // What is known already is passed over. The error is the link's, a segment out of turn, or that
  // the route cannot be driven backwards.
  [[nodiscard]] Result<void> Take(Feed item);

  // Nothing before the route itself is known.
  [[nodiscard]] const std::optional<route::RouteInfo>& route() const { return route_; }
  [[nodiscard]] ReplaySession* session() { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] const ReplaySession* session() const { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] std::uint32_t segments() const { return segments_; }  // given to the session
  // Those that are kept until all are known, too.
  [[nodiscard]] std::size_t taken() const { return segments_ + to_turn_.size(); }
  [[nodiscard]] bool complete() const { return complete_; }  // those are all
  // As it is driven.
  [[nodiscard]] const std::optional<LeftAt>& left() const { return left_; }
  // The link follows another revision than the one that the session was made of; one line for
  // people. Empty: it does not.
  [[nodiscard]] const std::string& superseded() const { return superseded_; }

  // All of it is to be known before the robot drives, and is not.
  [[nodiscard]] bool AwaitsAll() const;
  // Of what lies ahead of where it begins: why the robot cannot drive it; one line for people.
  [[nodiscard]] std::optional<std::string> Refusal() const;
  // What has a limit and is not known; one line for people.
  [[nodiscard]] std::optional<std::string> NotKnown() const { return terrain_.NotKnown(); }
  [[nodiscard]] ReplayStep Comfortable(ReplayStep step) const {
    return comfort_.Apply(std::move(step));
  }
  // Metres from the route's beginning of a place that so many have been driven to, and the other
  // way round.
  [[nodiscard]] double OfRoute(double driven_m) const {
    return how_.backwards ? length_m_ - driven_m : driven_m;
  }
  // A step of the session with its place on the route.
  [[nodiscard]] ReplayStep OfRoute(ReplayStep step) const;

 private:
  void Begin(const route::RouteInfo& route);
  void GoOnFrom(LeftAt left);
  [[nodiscard]] Result<void> Complete();
  [[nodiscard]] Result<void> Add(route::Segment segment);

  HowToFollow how_;
  TerrainCheck terrain_;
  Comfort comfort_;
  std::optional<route::RouteInfo> route_;
  std::optional<ReplaySession> session_;
  std::uint32_t segments_ = 0;
  std::vector<route::Segment>
      to_turn_;            // of a route that is driven backwards, until it is complete
  double length_m_ = 0.0;  // of those
  bool complete_ = false;
  std::optional<LeftAt> left_;
  std::string superseded_;
};

}  // namespace trailcast::agent
