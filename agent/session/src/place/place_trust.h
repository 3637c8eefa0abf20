#pragma once

#include <string>
#include <string_view>

#include "agent/session/confidence.h"
#include "services/belief/route_belief.h"

namespace trailcast::agent {

struct PlaceTrustOptions {
  // A robot that has lost its place may stand and look for this long, before it is lost.
  double limit_s = 3.0;
};

// This tells how far a robot without odometry may trust the belief in its place: it follows while
// the place is held, and stands otherwise.
class PlaceTrust {
 public:
  explicit PlaceTrust(const PlaceTrustOptions& options = {}) : options_(options) {}

  // `dt_s` is since the last frame. `doubt` is a reason against following although the place is
  // held, or empty.
  [[nodiscard]] Verdict Judge(const belief::RouteBelief::Place& place, double dt_s,
                              std::string_view doubt = "");
  [[nodiscard]] bool ever_sure() const { return ever_sure_; }

 private:
  PlaceTrustOptions options_;
  bool ever_sure_ = false;
  double unsure_s_ = 0.0;
};

}  // namespace trailcast::agent
