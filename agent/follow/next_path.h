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

// The route that a robot drives along next: learnt while it follows another one, and looked for in
// the same pictures where it is to change over, so that it need not stand there. The control loop's
// thread.
class NextPath {
 public:
  // `wish`: which it is; its number is not looked at.
  NextPath(RobotDevice& device, RouteWish wish, KnownPath path);
  [[nodiscard]] const RouteWish& wish() const { return wish_; }
  // As a link feeds it. False: it will never be ready, since some of it is not to be had, or the
  // robot cannot drive it.
  [[nodiscard]] bool Learn(Feed item);
  // It may be looked for: all of it is known, and it was not looked for in vain.
  [[nodiscard]] bool ready() const;

  // How a robot that was told to drive like this drives while it looks, `left_m` before it gives
  // up: however long a look takes, it comes about so far meanwhile and no further.
  [[nodiscard]] motion::VelocityCommand WhileItLooks(motion::VelocityCommand command,
                                                     double left_m) const;
  // At the joint, once it is ready. True: the robot is sure that it is on this route, about where
  // it begins, and drives along it from now on.
  [[nodiscard]] bool TakesOver(const Observation& observation);

  // Of one that has taken over; once.
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
  std::chrono::duration<double> look_;  // how long the last one took
  // Of a robot that drives along it, which stands unless somebody else drives it on (Take).
  std::optional<Standstill> standstill_;
  ReplayStep driving_by_;
};

}  // namespace trailcast::agent
