#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::demo {

// An operator's knowledge of a fleet, from the statuses that its agents publish.
class FleetView {
 public:
  // Takes the messages that concern the fleet and ignores the others. An agent that has gone keeps
  // its last status, because its end is of interest.
  void Handle(const exchange::Message& message);

  // Returns null for an agent that was never heard.
  [[nodiscard]] const exchange::AgentStatus* Find(const AgentId& agent) const;

 private:
  std::map<AgentId, exchange::AgentStatus> agents_;
};

// Returns one line with name, camera, a bar, and what it does. `status` is null if nothing was
// heard yet.
[[nodiscard]] std::string StatusLine(const std::string& name, const std::string& camera,
                                     const exchange::AgentStatus* status);

}  // namespace trailcast::demo
