#pragma once

#include <chrono>
#include <optional>

#include "agent/link/operator_hold.h"
#include "services/base/mailbox.h"
#include "services/exchange/messages.h"
#include "services/mission/driver_seat.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// How a robot that teaches is driven from afar: what operators say comes in by the link's thread,
// and is asked for by the control loop, which waits for nothing. No clock of its own.
class Hands {
 public:
  using Time = mission::DriverSeat::Time;

  // The link's thread.
  void Hear(const exchange::DriveCommand& command, Time now);
  void Tell(const Hold& hold);

  // The control loop, once a frame; what follows is as it was then.
  void Take();
  [[nodiscard]] const Hold& hold() const { return hold_; }
  // What the robot is to be told: to stand, where it is held or its driver has fallen silent.
  // Nothing: nobody drives it from here, which is not to say that nobody does.
  [[nodiscard]] std::optional<motion::VelocityCommand> Wanted(Time now) const;

 private:
  struct Word {
    exchange::DriveCommand command{};
    Time at{};
  };

  Hold told_;  // the link's thread
  Mailbox<Hold> holds_{16};
  // A loop that lets more than these lie is not driving.
  Mailbox<Word> words_{64};
  Hold hold_;
  mission::DriverSeat seat_;
  motion::VelocityCommand command_;
};

}  // namespace trailcast::agent
