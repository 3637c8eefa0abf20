#pragma once

#include <chrono>
#include <optional>

#include "agent/link/operator_hold.h"
#include "services/base/mailbox.h"
#include "services/exchange/messages.h"
#include "services/mission/driver_seat.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// Lets operators drive a teaching robot remotely. The link's thread takes their commands, and the
// control loop asks for them without waiting. It has no clock of its own.
class Teleoperation {
 public:
  using Time = mission::DriverSeat::Time;

  // For the link's thread.
  void Hear(const exchange::DriveCommand& command, Time now);
  void Tell(const Hold& hold);

  // For the control loop, once a frame; the functions below then return the state at that moment.
  void Take();
  [[nodiscard]] const Hold& hold() const { return hold_; }
  // Returns the command for the robot: to stop, if it is held or its driver has fallen silent. It
  // is nothing if nobody drives it from here, although somebody else may.
  [[nodiscard]] std::optional<motion::VelocityCommand> Wanted(Time now) const;

 private:
  struct Word {
    exchange::DriveCommand command{};
    Time at{};
  };

  Hold told_;  // for the link's thread
  Mailbox<Hold> holds_{16};
  // A loop that lets more than these wait is not driving.
  Mailbox<Word> words_{64};
  Hold hold_;
  mission::DriverSeat seat_;
  motion::VelocityCommand command_;
};

}  // namespace trailcast::agent
