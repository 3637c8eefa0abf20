#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "services/base/ids.h"
#include "services/base/newest_map.h"
#include "services/exchange/messages.h"
#include "services/mission/driver_seat.h"

namespace trailcast::console {

// This is teleoperation by the people at this console. If several drive one robot, the first
// counts, until they are silent for a moment. A command that waits is replaced by the next. It may
// be used from any thread.
class Driving {
 public:
  using Time = mission::DriverSeat::Time;
  // Robots' names come from strangers, so no more than these are kept.
  static constexpr std::size_t kMostRobots = 256;
  static constexpr std::size_t kMostHeard = 1024;
  // A robot that was not heard for so long does not hear this console either.
  static constexpr std::chrono::seconds kHeardWithin{10};

  struct Word {
    double linear_mps = 0.0;
    double turn_radps = 0.0;
    std::string driver{};       // a page or a program
    std::uint64_t said_ms = 0;  // by the driver's own clock
  };
  // Takes a robot's status: only robots that are heard and teach are driven.
  void Note(const exchange::AgentStatus& status, Time now);

  enum class Verdict { kGood, kLate, kTaken, kUnknown, kTeachesNothing };
  // Takes a command. kUnknown means that no robot of this name is heard.
  [[nodiscard]] Verdict Hear(const AgentId& robot, const Word& word, Time now);

  // Returns the commands to robots, once: the latest for each.
  [[nodiscard]] std::vector<exchange::DriveCommand> Take(const AgentId& self);

 private:
  std::mutex mutex_;
  struct Robot {
    bool teaches = false;
    Time heard_at{};
  };
  NewestMap<AgentId, Robot> robots_{kMostHeard};
  NewestMap<AgentId, mission::DriverSeat> seats_{kMostRobots};
  std::map<AgentId, exchange::DriveCommand> waiting_;
};

}  // namespace trailcast::console
