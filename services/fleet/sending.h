#pragma once

#include <chrono>
#include <optional>
#include <utility>

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
  // It is known what becomes of it at first: the robot has answered, or did not while a server
  // keeps it, or neither within `timeout`.
  [[nodiscard]] bool Answered(std::chrono::milliseconds since,
                              std::chrono::milliseconds timeout) const;
  // By the robot's word, or a server's, which may not have what the robot heard itself, and which
  // the robot has not contradicted meanwhile.
  [[nodiscard]] bool Ended(std::chrono::milliseconds since) const;
  [[nodiscard]] const std::optional<mission::Report>& last() const { return last_; }

 private:
  mission::Mission mission_;
  std::optional<mission::Report> last_;
};

}  // namespace trailcast::fleet
