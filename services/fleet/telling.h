#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/fleet/now_client.h"

namespace trailcast::fleet {

// This is an operator's command to robots, with their answers. It has no I/O and no clock:
// commands() are to be published repeatedly, while Hear takes every message that is heard.
class Telling {
 public:
  Telling(const AgentId& self, exchange::NowOrder order, std::vector<NowTarget> targets,
          const std::string& reason);

  [[nodiscard]] const std::vector<exchange::NowCommand>& commands() const { return commands_; }
  void Hear(const exchange::Message& message);
  // Waits for the answer of a robot that the command is for, and names it, whether or not it is
  // heard. `last_known` says in one line what was last known of it.
  void Expect(const std::string& robot, const std::string& last_known);
  // Notes that there is a robot of this name, whether or not the command is for it.
  void Note(const std::string& robot) { names_.insert(robot); }
  // Does the same for a robot that a server has on a mission, if the command is for it.
  void Expect(const mission::Record& record);
  // Returns whether all robots are named. A command to a route or to all first has to find out
  // which robots there are.
  [[nodiscard]] bool only_named() const;
  // Returns whether all have answered. For a route or for all it takes a while to hear which robots
  // there are.
  [[nodiscard]] bool AllAnswered(std::chrono::milliseconds since) const;
  // Returns the answers sorted by name. They are empty if no robot was heard that the command is
  // for.
  [[nodiscard]] std::vector<RobotsWord> Words() const;

 private:
  [[nodiscard]] bool Answers(const exchange::NowAnswer& answer) const;
  [[nodiscard]] bool IsNamed(const std::string& robot) const;
  [[nodiscard]] bool IsMeant(const exchange::AgentStatus& status) const;

  exchange::NowOrder order_;
  std::vector<NowTarget> targets_;
  std::vector<exchange::NowCommand> commands_;
  std::map<std::string, RobotsWord> words_;
  std::set<std::string> names_;
  // These are the missions in each robot's queue that servers have cancelled for this command.
  std::map<std::string, std::set<std::string>> dropped_;
};

}  // namespace trailcast::fleet
