#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "services/exchange/messages.h"
#include "services/fleet/robot_state.h"

namespace trailcast::fleet {

// This collects what robots report and what a server has of their missions, which is all there is
// for a robot that is not heard. It has no I/O and no clock; Hear takes every message that is
// heard.
class RobotsThere {
 public:
  // Strangers can make up names, so no more robots than this are kept.
  static constexpr std::size_t kMost = 1024;

  void Hear(const exchange::Message& message);
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  // Returns whether any is heard, for a server may have told of all of them.
  [[nodiscard]] bool any_heard() const;
  // Returns a table with a line for each robot, sorted by name. It is empty if there is none.
  [[nodiscard]] std::string Text() const;
  // Returns an array of objects for programs, in which null is what a robot does not report.
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
