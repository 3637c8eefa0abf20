#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/exchange/messages.h"

namespace trailcast::fleet {

// What is heard of one mission that was sent. No I/O, no clock: the mission is to be published,
// again and again, while everything that is heard goes to Hear.
class Sending {
 public:
  explicit Sending(mission::Mission mission) : mission_(std::move(mission)) {}

  [[nodiscard]] const mission::Mission& mission() const { return mission_; }
  // Whether that was news of it.
  bool Hear(const exchange::Message& message);
  // It is known what becomes of it at first: the robot does it or has refused it, or has taken it
  // and not refused it for a while, or did not answer while a server keeps it, or waits in its
  // queue at a server, or neither within `timeout`.
  [[nodiscard]] bool Answered(std::chrono::milliseconds since,
                              std::chrono::milliseconds timeout) const;
  // How long to wait before it is said again: what was lost is said soon, and while it is watched a
  // server or agent that has started again hears it anew.
  [[nodiscard]] std::chrono::milliseconds SayAgain() const;
  // By the robot's word, or a server's, which may not have what the robot heard itself, and which
  // the robot has not contradicted meanwhile.
  [[nodiscard]] bool Ended(std::chrono::milliseconds since) const;
  [[nodiscard]] const std::optional<mission::Report>& last() const { return last_; }
  // `last`; where there is none, kUnavailable: why a server has put it off, or that nobody answered
  // within `timeout`.
  [[nodiscard]] Result<mission::Report> Outcome(std::chrono::milliseconds timeout) const;

 private:
  mission::Mission mission_;
  std::string put_off_;  // why; empty: no server has said so
  std::optional<mission::Report> last_;
};

}  // namespace trailcast::fleet
