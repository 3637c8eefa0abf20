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

// Makes what openapi.yaml calls State of what FleetState::Shown gives, without line breaks.
[[nodiscard]] std::string StateBody(const nlohmann::ordered_json& state, std::int64_t now_unix_ms);
// Makes what openapi.yaml calls Change: it has what of `state` is not as in `from`.
[[nodiscard]] std::string ChangeBody(const nlohmann::ordered_json& from,
                                     const nlohmann::ordered_json& state, std::int64_t now_unix_ms);

// What is live in the fleet: who was heard of it, what each was sent to do, the routes that robots
// are on. Robots that have fallen silent stay. No I/O, no clock of its own.
class FleetState {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names: beyond these the one goes that was not heard for longest.
  static constexpr std::size_t kMostAgents = 1024;
  static constexpr std::size_t kMostMissions = 256;
  static constexpr std::size_t kMissionsShown = 50;
  // An agent speaks five times a second; in a large fleet each has program::Presence's share.
  static constexpr std::chrono::milliseconds kSilentAfter{3000};
  // A route that nobody tells of is asked for so often, so many at once.
  static constexpr std::chrono::milliseconds kAskForRouteEvery{10'000};
  static constexpr std::size_t kMostAskedFor = 8;
  // Who stood, free, when it was heard last, and is not heard for so long, is listed no more.
  static constexpr std::chrono::hours kGoneAfter{1};
  // A stop that was not answered is told again so often.
  static constexpr std::chrono::milliseconds kStopAgainEvery{500};

  // `self` asks for routes and missions: replies to it are taken.
  explicit FleetState(AgentId self) : self_(std::move(self)) {}

  void Handle(const exchange::Message& message, Time now, std::int64_t unix_ms);
  // What this console itself sends: without a server nobody else tells its orders.
  void Sent(const mission::Mission& mission, std::int64_t unix_ms);
  // Who has fallen silent meanwhile, or is gone, and which routes robots are on.
  void Tick(Time now);
  // A person wants a robot that is not heard listed no more; heard again, it is. kNotFound;
  // kConflict: it is heard, or may have to be stopped yet.
  [[nodiscard]] Result<void> Forget(const AgentId& robot, Time now);
  [[nodiscard]] bool Teaches(const AgentId& robot) const;
  // Whether it was heard, or said by what it does to be there; and all who were.
  [[nodiscard]] bool Knows(const AgentId& robot) const;
  [[nodiscard]] std::vector<std::string> Robots() const;
  struct Known {
    AgentId robot{};
    std::string last_seen{};  // as fleet::LastSeenText
  };
  // Returns the robots that take operators' orders and have not ended, heard or not: they may be
  // moving.
  [[nodiscard]] std::vector<Known> MayMove(Time now) const;
  // A robot that has not answered a stop is told it again until it has, or stands by another's, or
  // has ended, or is released here. Of one that was never heard nothing is kept.
  // `told_at`: when that began; a release since then is the later word.
  void KeepTelling(const AgentId& robot, const exchange::NowCommand& stop, Time told_at,
                   std::int64_t unix_ms);
  void Release(const AgentId& robot, Time now);
  // Returns the stops that are due to be told again now.
  [[nodiscard]] std::vector<exchange::NowCommand> TakeOpenStops(Time now);
  // Servers were asked for the last missions: that there are none is known from their answer.
  void AskedForMissions(std::uint64_t request) { asked_for_missions_ = request; }
  // No server has answered that yet, or a robot tells of a mission whose orders are not known here.
  [[nodiscard]] bool lacks_missions() const { return lacks_orders_ || !missions_told_; }
  // Routes that robots are on and of which more is to be asked now.
  [[nodiscard]] std::vector<RouteId> TakeLackingRoutes(Time now);

  // Shows what openapi.yaml calls State, but for its time: robots by name, with the same members;
  // missions are null until it is known whether there are any.
  [[nodiscard]] nlohmann::ordered_json Shown() const;
  // What somebody has to see to, and who is known. A battery that is low is said to be so until it
  // is charged a little: `open` has that it was.
  struct ToSeeTo {
    std::vector<Cause> causes{};
    std::set<std::string> subjects{};
    std::set<std::string> unsure{};  // of whose missions nothing was told yet
  };
  // Returns whom Tick and Forget have taken off the list since the last call.
  [[nodiscard]] std::vector<AgentId> TakeGone() { return std::exchange(gone_, {}); }
  [[nodiscard]] ToSeeTo WhatToSeeTo(const Alerts& open) const;
  // Robots, servers and missions, for Prometheus.
  void Measure(http::MetricsText& text) const;

 private:
  // Where a robot said last that it stands.
  struct Stood {
    std::string route{};
    exchange::PlaceOnRoute place{};
  };
  // A stop that its robot has not answered yet.
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
  // That a robot is on.
  struct Route {
    std::optional<route::RouteInfo> info{};
    std::optional<Time> asked_at{};
  };
  // How a robot is doing.
  struct Standing {
    fleet::RobotState state{};
    bool needs_person = false;
    const mission::Record* mission = nullptr;  // that has not ended
    const mission::Report* last = nullptr;     // of the newest that it has taken
  };
  using MissionName = std::pair<AgentId, std::string>;
  using Latest = std::map<AgentId, const mission::Record*>;

  void On(const exchange::AgentStatus& status, Time now, std::int64_t unix_ms);
  void On(const exchange::NowAnswer& answer);
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
  [[nodiscard]] nlohmann::ordered_json MissionsShown() const;

  AgentId self_;
  NewestMap<AgentId, Agent> agents_{kMostAgents};
  NewestMap<MissionName, mission::Record> missions_{kMostMissions};
  std::map<mission::State, std::uint64_t> became_;  // how often missions were seen to
  std::map<route::RouteKey, Route> routes_;
  std::vector<AgentId> gone_;
  bool lacks_orders_ = false;
  bool missions_told_ = false;
  std::optional<std::uint64_t> asked_for_missions_{};
};

}  // namespace trailcast::console
