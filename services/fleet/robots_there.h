#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/exchange/messages.h"

namespace trailcast::fleet {

// What a robot does: "driving".
[[nodiscard]] const char* ToText(exchange::AgentMode mode);

// What robots say of themselves. No I/O, no clock: everything that is heard goes to Hear.
class RobotsThere {
 public:
  // Strangers can make up names: more are not kept.
  static constexpr std::size_t kMost = 1024;

  void Hear(const exchange::Message& message);
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  // A line a robot, by name, below a line of heads. Empty where there is none.
  [[nodiscard]] std::string Text() const;
  // For programs: an array of objects; null is what a robot does not tell.
  [[nodiscard]] nlohmann::ordered_json Json() const;

 private:
  std::map<AgentId, exchange::AgentStatus> robots_;
};

}  // namespace trailcast::fleet
