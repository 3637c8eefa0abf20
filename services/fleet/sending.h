#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::fleet {

// This follows one mission that is sent. It has no I/O and no clock: the mission is to be published
// repeatedly, while Hear takes every message that is heard.
class Sending {
 public:
  explicit Sending(mission::Mission mission) : mission_(std::move(mission)) {}

  [[nodiscard]] const mission::Mission& mission() const { return mission_; }
  // Takes a message, and returns whether it was news of the mission.
  bool Hear(const exchange::Message& message);
  // Returns whether the first outcome is known. The robot does the mission or has refused it, or
  // has accepted it and not refused it for a while; or it did not answer while a server keeps the
  // mission, or the mission waits in its queue at a server; or neither answered within `timeout`.
  [[nodiscard]] bool Answered(std::chrono::milliseconds since,
                              std::chrono::milliseconds timeout) const;
  // Returns how long to wait before the mission is sent again. A lost message is repeated soon, and
  // while the mission is watched, a server or agent that has restarted hears it anew.
  [[nodiscard]] std::chrono::milliseconds SayAgain() const;
  // Returns whether the mission has ended, by the robot's report or by a server's. A server may not
  // have what the robot heard itself, so its report counts if the robot has not contradicted it
  // meanwhile.
  [[nodiscard]] bool Ended(std::chrono::milliseconds since) const;
  [[nodiscard]] const std::optional<mission::Report>& last() const { return last_; }
  // Returns `last`. Without it, fails with kUnavailable: either why a server has put the mission
  // off, or that nobody answered within `timeout`.
  [[nodiscard]] Result<mission::Report> Outcome(std::chrono::milliseconds timeout) const;

 private:
  mission::Mission mission_;
  std::string put_off_;  // the reason; empty if no server has put it off
  std::optional<mission::Report> last_;
};

// This follows a mission that is sent to a robot, a group, or several of them (mission/address.h),
// in the same way.
class SendingToAll {
 public:
  explicit SendingToAll(mission::Mission mission);

  [[nodiscard]] const mission::Mission& mission() const { return whole_.mission(); }
  // Takes a message, and returns it if it was news of the mission.
  std::optional<mission::Report> Hear(const exchange::Message& message);
  // These are true if they are for each robot or group, or the mission was refused for all.
  [[nodiscard]] bool Answered(std::chrono::milliseconds since,
                              std::chrono::milliseconds timeout) const;
  [[nodiscard]] bool Ended(std::chrono::milliseconds since) const;
  [[nodiscard]] bool heard() const;
  [[nodiscard]] std::chrono::milliseconds SayAgain() const;
  // Returns a report for each of which one is known, or the one by which it is refused for all.
  [[nodiscard]] Result<std::vector<mission::Report>> Outcome(
      std::chrono::milliseconds timeout) const;

 private:
  template <typename Holds>
  [[nodiscard]] bool ForAll(const Holds& holds) const;

  Sending whole_;
  std::vector<Sending> each_;
};

}  // namespace trailcast::fleet
