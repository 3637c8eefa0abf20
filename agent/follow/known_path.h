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

// How a robot is to drive along any route.
struct HowToFollow {
  ReplayMethodOptions session;
  // The ground that the robot can drive. With limits it checks all of a complete route before it
  // moves; of a route that is still being taught, it knows only the part that has come.
  TerrainLimits terrain{};
  bool comfort = false;  // it drives more slowly where the ground is rough
  // It reverses from the route's end to its beginning, at route::kBackwardsPace, once it knows all
  // of it.
  bool backwards = false;
};

// The control loop's knowledge of its route, as far as its link has fed it. The session counts
// metres and segments as they are driven; OfRoute converts them to the route's.
class KnownPath {
 public:
  explicit KnownPath(const HowToFollow& how);

  // Takes an item; it skips what is known already. Errors: the link's own, a segment out of order,
  // or a route that cannot be driven backwards.
  [[nodiscard]] Result<void> Take(Feed item);

  // Nothing before the route itself is known.
  [[nodiscard]] const std::optional<route::RouteInfo>& route() const { return route_; }
  [[nodiscard]] ReplaySession* session() { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] const ReplaySession* session() const { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] std::uint32_t segments() const { return segments_; }  // in the session
  // Returns their number with those that are kept until all are known.
  [[nodiscard]] std::size_t taken() const { return segments_ + to_turn_.size(); }
  [[nodiscard]] bool complete() const { return complete_; }  // all have come
  // In the direction of driving.
  [[nodiscard]] const std::optional<LeftAt>& left() const { return left_; }
  // Returns, as one line for people, that the link follows another revision than the session, or an
  // empty text.
  [[nodiscard]] const std::string& superseded() const { return superseded_; }

  // Says whether the robot has to know all of it before it drives, and does not yet.
  [[nodiscard]] bool AwaitsAll() const;
  // Returns why the robot cannot drive what lies ahead of its beginning, as one line for people.
  [[nodiscard]] std::optional<std::string> Refusal() const;
  // Returns what has a limit but is not known, as one line for people.
  [[nodiscard]] std::optional<std::string> NotKnown() const { return terrain_.NotKnown(); }
  [[nodiscard]] ReplayStep Comfortable(ReplayStep step) const {
    return comfort_.Apply(std::move(step));
  }
  // Converts between metres driven and metres from the route's beginning, in both directions.
  [[nodiscard]] double OfRoute(double driven_m) const {
    return how_.backwards ? length_m_ - driven_m : driven_m;
  }
  // Returns a step of the session with its place on the route.
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
      to_turn_;            // segments of a route to be driven backwards, until it is complete
  double length_m_ = 0.0;  // their length
  bool complete_ = false;
  std::optional<LeftAt> left_;
  std::string superseded_;
};

}  // namespace trailcast::agent
