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
#include "services/program/presence.h"
#include "services/store/route_store.h"

namespace trailcast::agent {

struct OnDutyOptions {
  AgentId agent;
  std::filesystem::path missions_file;  // what it is sent to do is kept here,
  std::filesystem::path stop_file;      // and here that an operator has stopped it; empty: nowhere
  RunLogsOptions logs;                  // of each following
  // How it follows the route of a task; name, place, part and pace of the task are set here.
  std::function<FollowerOptions(const mission::Task&)> follower;
  // How it teaches that of a task; name and tags of the task are set here.
  std::function<ScoutOptions(const mission::Task&)> scout;
  std::string why_no_scout;                  // not empty: it does not teach
  Refreshing refreshing = Refreshing::kOff;  // of what it has followed
  // Of the agent's routes, for each following, and each teaching.
  std::function<Result<std::unique_ptr<store::RouteStore>>()> open_store;
  std::function<Result<std::unique_ptr<store::RouteStore>>()> open_scouts_store;
  std::function<program::Vitals()> vitals = [] { return program::Vitals{}; };  // any thread
  std::function<bool()> stop = [] { return false; };                           // any thread
};

// Takes missions and does them with `device`, one at a time, until `options.stop` says so. After a
// restart in the middle of one the robot stands until it is told to resume, unless the mission says
// that it goes on; a teaching has failed then, and what was taught is kept. The errors: another
// agent has the name; the missions of an earlier run cannot be read.
[[nodiscard]] Result<void> ServeOnDuty(RobotDevice& device, const OnDutyOptions& options,
                                       std::unique_ptr<exchange::RouteExchange> exchange);

}  // namespace trailcast::agent
