#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "agent/device/device.h"
#include "agent/duty/refreshing.h"
#include "agent/duty/run_logs.h"
#include "agent/follow/follower.h"
#include "agent/teach/scout.h"
#include "services/exchange/route_exchange.h"
#include "services/mission/orders.h"
#include "services/photos/photo_folder.h"
#include "services/program/presence.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

struct OnDutyOptions {
  AgentId agent;
  std::filesystem::path missions_file;  // keeps the missions that it was sent
  std::filesystem::path stop_file;      // keeps an operator's stop; empty for none
  RunLogsOptions logs;                  // for each route that it follows
  // Returns the options for following a task's route. Name, place, part and pace of the task are
  // already set.
  std::function<FollowerOptions(const mission::Task&)> follower;
  // Returns the options for teaching a task's route. Name and tags of the task are already set.
  std::function<ScoutOptions(const mission::Task&)> scout;
  std::string why_no_scout;                     // if not empty, it does not teach
  Refreshing refreshing = Refreshing::kOff;     // for routes that it has followed
  photos::PhotoFolder* photo_folder = nullptr;  // keeps those of its missions; null: it takes none
  // Open the store of the agent's routes, for following and for teaching.
  std::function<Result<std::unique_ptr<store::RouteStore>>()> open_store;
  std::function<Result<std::unique_ptr<store::RouteStore>>()> open_scouts_store;
  // called by any thread
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };
  std::function<bool()> stop = [] { return false; };  // called by any
                                                      // thread
};

// Takes missions and does them with `device`, one at a time, until `options.stop` returns true.
// After a restart in the middle of a mission, the robot stands until it is told to resume, unless
// the mission says that it goes on. A teaching has then failed, and its part is kept. Errors:
// another agent has the name; the missions of an earlier run cannot be read.
[[nodiscard]] Result<void> ServeOnDuty(RobotDevice& device, const OnDutyOptions& options,
                                       std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
