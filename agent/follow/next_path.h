#pragma once

#include <chrono>
#include <optional>
#include <utility>

#include "agent/device/device.h"
#include "agent/device/standstill.h"
#include "agent/follow/known_path.h"
#include "agent/link/feed.h"
#include "agent/link/route_wish.h"
#include "agent/session/replay_step.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// The route that a robot drives next. It is learnt while the robot follows another route, and is
// sought in the same pictures where the robot changes over, so that it need not stop there. It
// belongs to the control loop's thread.
class NextPath {
 public:
  // `wish` names the route; its number does not matter.
  NextPath(RobotDevice& device, RouteWish wish, KnownPath path);
  [[nodiscard]] const RouteWish& wish() const { return wish_; }
  // Takes an item from the link. False means that it will never be ready, because part of it cannot
  // be had, or the robot cannot drive it.
  [[nodiscard]] bool Learn(Feed item);
  // Says whether it may be sought: all of it is known, and it was not sought in vain.
  [[nodiscard]] bool ready() const;

  // Returns the command for a robot that looks for the route, slowed so that it drives about
  // `left_m` before it gives up, however long a look takes.
  [[nodiscard]] motion::VelocityCommand WhileItLooks(motion::VelocityCommand command,
                                                     double left_m) const;
  // Looks for the route at the junction, once it is ready. Returns true if the robot is sure that
  // it is on the route, about where it begins; it then drives along it.
  [[nodiscard]] bool TakesOver(const Observation& observation);

  // The state of a path that has taken over; it can be taken once.
  struct Begun {
    KnownPath path;
    ReplayStep step;  // the last
  };
  [[nodiscard]] Begun Take();

 private:
  RobotDevice& device_;
  RouteWish wish_;
  KnownPath path_;
  int looks_ = 0;
  std::chrono::duration<double> look_;  // duration of the last look
  // Stops a robot that drives along it, unless somebody else drives it on (Take).
  std::optional<Standstill> standstill_;
  ReplayStep driving_by_;
};

}  // namespace trailcast::agent
