#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "agent/comfort.h"
#include "agent/link/feed.h"
#include "agent/session/replay_session.h"
#include "agent/terrain_check.h"
#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::agent {

// What a control loop knows of the route that it follows, as far as its link has fed it.
class KnownPath {
 public:
  KnownPath(const ReplayMethodOptions& method, const TerrainLimits& terrain, bool comfort)
      : method_(method), terrain_(terrain), comfort_(comfort) {}

  // What is known already is passed over. The error is the link's, or a segment out of turn.
  [[nodiscard]] Result<void> Take(Feed item);

  // Nothing before the route itself is known.
  [[nodiscard]] const std::optional<route::RouteInfo>& route() const { return route_; }
  [[nodiscard]] ReplaySession* session() { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] const ReplaySession* session() const { return session_ ? &*session_ : nullptr; }
  [[nodiscard]] std::uint32_t segments() const { return segments_; }  // given to the session
  [[nodiscard]] bool complete() const { return complete_; }           // those are all
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

 private:
  void Begin(const route::RouteInfo& route);
  [[nodiscard]] Result<void> Add(route::Segment segment);

  ReplayMethodOptions method_;
  TerrainCheck terrain_;
  Comfort comfort_;
  std::optional<route::RouteInfo> route_;
  std::optional<ReplaySession> session_;
  std::uint32_t segments_ = 0;
  bool complete_ = false;
  std::optional<LeftAt> left_;
  std::string superseded_;
};

}  // namespace trailcast::agent
