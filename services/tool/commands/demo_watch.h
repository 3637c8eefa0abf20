#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "services/exchange/route_exchange.h"
#include "services/lab/demo/demo_fleet.h"
#include "services/lab/demo/fleet_view.h"

namespace trailcast::tool {

enum class Watched { kEnded, kInterrupted, kBroken, kTooLong };

struct WatchOptions {
  double timeout_s = std::numeric_limits<double>::infinity();
  std::function<std::string(double)> headline;  // after so many seconds
  std::function<void(const std::vector<exchange::Message>&)> hear =
      [](const std::vector<exchange::Message>&) {};
  // It is called again and again, with what is known of the fleet. It returns true if there is no
  // more to see.
  std::function<Result<bool>(const demo::FleetView&)> step =
      [](const demo::FleetView&) -> Result<bool> { return false; };
};

// Shows the robots of a demo until they have ended or there is a reason to stop, which it prints on
// stderr.
[[nodiscard]] Watched WatchFleet(demo::DemoFleet& fleet, const std::vector<demo::DemoRobot>& robots,
                                 exchange::RouteExchange& exchange, WatchOptions options);

}  // namespace trailcast::tool
