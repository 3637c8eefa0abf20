#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/fleet/now_client.h"

namespace trailcast::fleet {

// What an operator tells robots to do now, and what they answer. No I/O, no clock: commands() are
// to be published, again and again, while everything that is heard goes to Hear.
class Telling {
 public:
  Telling(const AgentId& self, exchange::NowOrder order, std::vector<NowTarget> targets,
          const std::string& reason);

  [[nodiscard]] const std::vector<exchange::NowCommand>& commands() const { return commands_; }
  void Hear(const exchange::Message& message);
  // A robot that this is meant for is waited for and named, heard or not: `last_known` says in a
  // line what was last known of it.
  void Expect(const std::string& robot, const std::string& last_known);
  // A robot of this name there is, meant or not.
  void Note(const std::string& robot) { names_.insert(robot); }
  // The same of one that a server has on a mission, if it is meant.
  void Expect(const mission::Record& record);
  // All are named; else, of a route or of all, it has to be found out who there is.
  [[nodiscard]] bool only_named() const;
  // Of a route or of all it takes a while to hear who is there.
  [[nodiscard]] bool AllAnswered(std::chrono::milliseconds since) const;
  // By name. Empty where nobody was heard that is meant.
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
  // The missions in each robot's queue that servers have cancelled for this command.
  std::map<std::string, std::set<std::string>> dropped_;
};

}  // namespace trailcast::fleet
