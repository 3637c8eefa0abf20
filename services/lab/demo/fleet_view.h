#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::demo {

// What an operator knows of a fleet, from the statuses that its agents publish.
class FleetView {
 public:
  // Takes what concerns the fleet out of a message; all else is ignored. An agent that has gone
  // keeps its last status: what it ended with is what one wants to see.
  void Handle(const exchange::Message& message);

  // Null for an agent never heard of.
  [[nodiscard]] const exchange::AgentStatus* Find(const AgentId& agent) const;

 private:
  std::map<AgentId, exchange::AgentStatus> agents_;
};

// One line: name, camera, a bar, what it does. `status` may be null: nothing heard yet.
[[nodiscard]] std::string StatusLine(const std::string& name, const std::string& camera,
                                     const exchange::AgentStatus* status);

}  // namespace trailcast::demo
