#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "services/exchange/messages.h"
#include "services/fleet/robot_state.h"

namespace trailcast::fleet {

// What robots say of themselves, and what a server has of their missions: of one that is not heard
// that is all there is. No I/O, no clock: everything that is heard goes to Hear.
class RobotsThere {
 public:
  // Strangers can make up names: more are not kept.
  static constexpr std::size_t kMost = 1024;

  void Hear(const exchange::Message& message);
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  // Not all of them may be heard.
  [[nodiscard]] bool any_heard() const;
  // A line a robot, by name, below a line of heads. Empty where there is none.
  [[nodiscard]] std::string Text() const;
  // For programs: an array of objects; null is what a robot does not tell.
  [[nodiscard]] nlohmann::ordered_json Json() const;

 private:
  struct Robot {
    exchange::AgentStatus status{};
    bool heard = false;
    std::optional<mission::Record> mission{};  // the newest that it has taken
  };
  [[nodiscard]] Robot* Known(const AgentId& name);
  void Note(const exchange::MissionReply& reply);
  [[nodiscard]] static RobotState StateOf(const Robot& robot);
  [[nodiscard]] static std::string DetailOf(const Robot& robot);
  [[nodiscard]] static std::string Says(const Robot& robot);
  [[nodiscard]] static nlohmann::ordered_json JsonOf(const Robot& robot);

  std::map<AgentId, Robot> robots_;
};

}  // namespace trailcast::fleet
