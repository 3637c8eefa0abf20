#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "agent/session/replay_step.h"
#include "services/base/ids.h"
#include "services/base/newest_map.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::agent {

// How a robot has followed each stretch of its routes (exchange::kFollowedStretch_m), until servers
// are told: how often it came over it, and how often it lost its path there, found again or not.
//
// It counts from when the robot was sure of its path. What has it stand for another reason (its
// camera, people, other robots) is no fault of the stretch. No clock.
class FollowedNote {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kEvery{10};
  // A robot that is so much further back has come anew.
  static constexpr double kBack_m = 1.0;
  // While nobody hears it: 20 km of routes. Of more, what was driven last is kept.
  static constexpr std::size_t kMostStretches = 4096;

  explicit FollowedNote(AgentId agent) : agent_(std::move(agent)) {}

  // Of a robot that was set down where it is.
  void Begin();
  // What became of a frame on the route.
  void Note(const ReplayStep& step, const route::RouteInfo& route);

  // Publishes all that is to be told; what cannot be handed over is kept.
  void Tell(exchange::RouteExchange& to);
  // The same, every kEvery.
  void TellIfDue(exchange::RouteExchange& to, Clock::time_point now);

 private:
  using Where = std::pair<route::RouteKey, std::uint32_t>;
  struct Count {
    std::uint32_t passed = 0;
    std::uint32_t lost = 0;
  };
  // The stretch where it is.
  struct Visit {
    Where where{};
    double furthest_m = 0.0;
    bool lost = false;  // and is counted
  };
  void Leave();
  void Add(const Where& where, Count more);
  [[nodiscard]] std::vector<exchange::Message> Take();
  void NotSent(const exchange::Message& message);

  AgentId agent_;
  std::optional<Visit> visit_;
  bool on_path_ = false;  // it was sure of it, and has lost it in no way since
  NewestMap<Where, Count> counts_{kMostStretches};
  Clock::time_point due_{};
};

}  // namespace trailcast::agent
