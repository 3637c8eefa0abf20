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

// Counts how a robot has followed each section of its routes (exchange::kFollowedSection_m) until
// servers are told: how often it passed the section, and how often it lost its path there, whether
// or not it found it again.
//
// It counts once the robot was sure of its path. A stop for another reason (its camera, people,
// other robots) is not the section's fault. It has no clock.
class FollowedNote {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kEvery{10};
  // A robot that is so much further back has come again.
  static constexpr double kBack_m = 1.0;
  // The bound while nobody hears it: 20 km of routes. The sections that were driven last are kept.
  static constexpr std::size_t kMostSections = 4096;

  explicit FollowedNote(AgentId agent) : agent_(std::move(agent)) {}

  // Begins with a robot that was set down where it is.
  void Begin();
  // Notes the outcome of a frame on the route.
  void Note(const ReplayStep& step, const route::RouteInfo& route);

  // Publishes all that is to be reported, and keeps what cannot be sent.
  void Tell(exchange::RouteExchange& to);
  // Does the same, every kEvery.
  void TellIfDue(exchange::RouteExchange& to, Clock::time_point now);

 private:
  using Where = std::pair<route::RouteKey, std::uint32_t>;
  struct Count {
    std::uint32_t passed = 0;
    std::uint32_t lost = 0;
  };
  // The section where the robot is.
  struct Visit {
    Where where{};
    double furthest_m = 0.0;
    bool lost = false;  // the loss is counted
  };
  void Leave();
  void Add(const Where& where, Count more);
  [[nodiscard]] std::vector<exchange::Message> Take();
  void NotSent(const exchange::Message& message);

  AgentId agent_;
  std::optional<Visit> visit_;
  bool on_path_ = false;  // it was sure of its path, and has not lost it since
  NewestMap<Where, Count> counts_{kMostSections};
  Clock::time_point due_{};
};

}  // namespace trailcast::agent
