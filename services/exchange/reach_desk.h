#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "services/exchange/messages.h"

namespace trailcast::exchange {

// This knows whom one program hears, how late and over which network, and answers those who ask for
// it. A server passes questions on and answers back, for agents that meet only the server; from
// these it measures how long a message takes there and back. No I/O, no clock.
class ReachDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names, so no more are kept.
  static constexpr std::size_t kMostAgents = 4096;
  // All robots answer each question that is passed on, so one that comes sooner has to be asked
  // again.
  static constexpr std::chrono::milliseconds kPassesOnEvery{100};

  ReachDesk(AgentId self, AgentRole role) : self_(std::move(self)), role_(role) {}

  // Takes in statuses, departures, questions and answers.
  void Handle(const Message& message, Time now);
  // Returns answers and passed-on messages, which have to be published now.
  [[nodiscard]] std::vector<Message> TakeOutgoing() { return std::exchange(outgoing_, {}); }
  // Notes a question that is published now. Its answers come here too.
  void NoteAsked(const ReachRequest& request, Time now);
  // Returns the agents by name.
  [[nodiscard]] std::vector<HeardAgent> Heard(Time now) const;

 private:
  struct Known {
    AgentRole role = AgentRole::kOperator;
    std::uint64_t instance = 0;
    Time since{};
    Time last{};
    Arrival arrival{};
    // This is the shortest time measured for this client; a longer one includes waiting for
    // something else.
    AgentId measured_for{};
    std::optional<double> round_trip_ms{};
  };
  void Hear(const AgentStatus& status, Time now);
  void Answer(const ReachRequest& request, Time now);
  void PassOn(const ReachRequest& request, Time now);
  void Measure(const ReachReport& report, Time now);

  AgentId self_;
  AgentRole role_;
  std::map<AgentId, Known> heard_;
  std::deque<std::pair<ReachRequest, Time>> asked_;  // lately
  std::optional<Time> passed_on_at_;
  std::vector<Message> outgoing_;
};

}  // namespace trailcast::exchange
