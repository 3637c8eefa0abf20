#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/base/newest_map.h"
#include "services/base/result.h"
#include "services/console/alerts.h"
#include "services/exchange/messages.h"
#include "services/fleet/robot_state.h"
#include "services/http/metrics_text.h"

namespace trailcast::console {

// Makes openapi.yaml's State from what FleetState::Shown returns, without line breaks.
[[nodiscard]] std::string StateBody(const nlohmann::ordered_json& state, std::int64_t now_unix_ms);
// Makes openapi.yaml's Change, which has what in `state` differs from `from`.
[[nodiscard]] std::string ChangeBody(const nlohmann::ordered_json& from,
                                     const nlohmann::ordered_json& state, std::int64_t now_unix_ms);

// This is the present state of the fleet: which members were heard, what each was sent to do, and
// the routes that robots are on. Robots that have fallen silent stay. It has no I/O and no clock of
// its own.
class FleetState {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names, so beyond these the one goes that was not heard for longest.
  static constexpr std::size_t kMostAgents = 1024;
  static constexpr std::size_t kMostMissions = 256;
  static constexpr std::size_t kMissionsShown = 50;
  // An agent reports five times a second, and in a large fleet at program::Presence's share.
  static constexpr std::chrono::milliseconds kSilentAfter{3000};
  // A route that is not announced is asked for so often, and so many at once.
  static constexpr std::chrono::milliseconds kAskForRouteEvery{10'000};
  static constexpr std::size_t kMostAskedFor = 8;
  // A robot that stood without a mission when it was last heard is no longer listed after this
  // long.
  static constexpr std::chrono::hours kGoneAfter{1};
  // A stop that was not answered is repeated so often.
  static constexpr std::chrono::milliseconds kStopAgainEvery{500};

  // `self` asks for routes and missions, and replies to it are taken.
  explicit FleetState(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now, std::int64_t unix_ms);
  // Takes what this console itself sends, because without a server nobody else tells the orders.
  void Sent(const mission::Mission& mission, std::int64_t unix_ms);
  // Updates which members have fallen silent or are gone, and which routes robots are on.
  void Tick(Time now);
  // Removes a robot that is not heard from the list, at a person's wish, until it is heard again.
  // Fails with kNotFound, and with kConflict if it is heard or may still have to be stopped.
  [[nodiscard]] Result<void> Forget(const AgentId& robot, Time now);
  [[nodiscard]] bool Teaches(const AgentId& robot) const;
  // These return whether a robot was heard or reported a mission, and all that did.
  [[nodiscard]] bool Knows(const AgentId& robot) const;
  [[nodiscard]] std::vector<std::string> Robots() const;
  // Returns the route servers that are heard, as of the last Tick.
  [[nodiscard]] std::vector<AgentId> ServersHeard() const;
  struct Known {
    AgentId robot{};
    std::string last_seen{};  // as fleet::LastSeenText
  };
  // Returns the robots that take operators' orders and have not ended, whether or not they are
  // heard, because they may be moving.
  [[nodiscard]] std::vector<Known> MayMove(Time now) const;
  // Repeats a stop to a robot that has not answered it until it has, or stands by another stop, or
  // has ended, or is released here. It keeps nothing for a robot that was never heard. `told_at` is
  // when the stop was first sent; a release since then replaces it.
  void KeepTelling(const AgentId& robot, const exchange::NowCommand& stop, Time told_at,
                   std::int64_t unix_ms);
  void Release(const AgentId& robot, Time now);
  // Returns the stops that are due to be repeated now.
  [[nodiscard]] std::vector<exchange::NowCommand> TakeOpenStops(Time now);
  // Notes that servers were asked for the last missions, because only their answer shows that there
  // are none.
  void AskedForMissions(std::uint64_t request) { asked_for_missions_ = request; }
  // Returns whether no server has answered that yet, or a robot reports a mission whose orders are
  // not known here.
  [[nodiscard]] bool lacks_missions() const { return lacks_orders_ || !missions_told_; }
  // Returns routes that robots are on and that are to be asked for now.
  [[nodiscard]] std::vector<RouteId> TakeLackingRoutes(Time now);

  // Returns openapi.yaml's State without its time: robots by name, with the same members. Missions
  // are null until it is known whether there are any.
  [[nodiscard]] nlohmann::ordered_json Shown() const;
  [[nodiscard]] nlohmann::ordered_json MissionsShown() const;  // as Shown has them
  // This is what people have to see to, and which members are known. A low battery is reported
  // until it is charged a little: `open` tells that it was low.
  struct ToSeeTo {
    std::vector<Cause> causes{};
    std::set<std::string> subjects{};
    std::set<std::string> unsure{};  // those whose missions are not known yet
  };
  // Returns the robots that Tick and Forget have removed from the list since the last call.
  [[nodiscard]] std::vector<AgentId> TakeGone() { return std::exchange(gone_, {}); }
  [[nodiscard]] ToSeeTo WhatToSeeTo(const Alerts& open) const;
  // Writes robots, servers and missions for Prometheus.
  void Measure(http::MetricsText& text) const;

 private:
  // This is where a robot last reported that it stands.
  struct Stood {
    std::string route{};
    exchange::PlaceOnRoute place{};
  };
  // This is a stop that its robot has not answered yet.
  struct OpenStop {
    exchange::NowCommand command{};
    std::int64_t since_unix_ms = 0;
    Time say_at{};
  };
  struct Agent {
    exchange::AgentStatus status{};
    std::optional<OpenStop> open_stop{};
    std::optional<Time> released_at{};
    std::optional<Stood> stood{};
    Time heard_at{};
    std::int64_t heard_unix_ms = 0;
    bool gone = false;
    bool silent = false;
  };
  // This is a route that a robot is on.
  struct Route {
    std::optional<route::RouteInfo> info{};
    std::optional<Time> asked_at{};
  };
  // This is the run status of a robot.
  struct Standing {
    fleet::RobotState state{};
    bool needs_person = false;
    const mission::Record* mission = nullptr;  // its mission that has not ended
    const mission::Report* last = nullptr;     // of the newest mission that it has taken
  };
  using MissionName = std::pair<AgentId, std::string>;
  using Latest = std::map<AgentId, const mission::Record*>;

  void On(const exchange::AgentStatus& status, Time now, std::int64_t unix_ms);
  void On(const exchange::NowAnswer& answer);
  // Says whether that mission is a group's that a robot has by now.
  [[nodiscard]] bool IsGiven(const MissionName& name) const;
  // Forgets that a group had the mission, if it is a robot's.
  void TakeFromGroups(const MissionName& name);
  void On(const mission::Report& report, std::int64_t unix_ms);
  void On(const exchange::MissionReply& reply);
  void On(const exchange::CatalogReply& reply);
  [[nodiscard]] Latest LatestMissions() const;
  void DropGone(Time now);
  void AddCauses(const Agent& agent, const Standing& standing, const Alerts& open,
                 std::vector<Cause>& causes) const;
  [[nodiscard]] static Standing StandingOf(const Agent& agent, const mission::Record* latest);
  [[nodiscard]] nlohmann::ordered_json RobotOf(const Agent& agent, const mission::Record* latest,
                                               const std::vector<mission::Record>& queue) const;
  // Returns the missions that wait for each robot, the next first.
  [[nodiscard]] std::map<AgentId, std::vector<mission::Record>> Queues() const;

  AgentId self_;
  NewestMap<AgentId, Agent> agents_{kMostAgents};
  NewestMap<MissionName, mission::Record> missions_{kMostMissions};
  std::map<mission::State, std::uint64_t> became_;  // how often missions were seen to reach it
  std::map<route::RouteKey, Route> routes_;
  std::vector<AgentId> gone_;
  bool lacks_orders_ = false;
  bool missions_told_ = false;
  std::optional<std::uint64_t> asked_for_missions_{};
};

}  // namespace trailcast::console
