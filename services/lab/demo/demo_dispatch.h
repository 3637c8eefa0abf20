#pragma once

#include <chrono>
#include <vector>

#include "services/exchange/messages.h"
#include "services/fleet/sending.h"
#include "services/lab/demo/demo_fleet.h"

namespace trailcast::demo {

// The operator of `trailcast demo --console`. It sends all robots that wait for missions, except
// the last one, along the scout's route as soon as there is enough of it; the last one is left to
// the viewer. It has no I/O and no clock.
class DemoDispatch {
 public:
  DemoDispatch(const AgentId& self, const std::vector<DemoRobot>& robots);

  void Hear(const std::vector<exchange::Message>& messages);
  // Returns the messages to publish now.
  [[nodiscard]] std::vector<exchange::Message> Due(std::chrono::steady_clock::time_point now);

 private:
  AgentId scout_;
  bool taught_ = false;
  std::vector<fleet::Sending> sendings_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace trailcast::demo
