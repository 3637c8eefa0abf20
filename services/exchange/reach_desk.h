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

// Whom one program hears, how late and over what, and the answers to who asks for that. A server
// passes questions on, and the answers back: who meets it alone hears no one else; by these it
// measures how long a message takes there and back. No I/O, no clock.
class ReachDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // Strangers can make up names: more are not kept.
  static constexpr std::size_t kMostAgents = 4096;
  // Each question that is passed on has all robots answer: what comes sooner is asked again.
  static constexpr std::chrono::milliseconds kPassesOnEvery{100};

  ReachDesk(AgentId self, AgentRole role) : self_(std::move(self)), role_(role) {}

  // Statuses, who is gone, questions and answers.
  void Handle(const Message& message, Time now);
  // Answers, and what is passed on, to be published now.
  [[nodiscard]] std::vector<Message> TakeOutgoing() { return std::exchange(outgoing_, {}); }
  // A question that is published now, whose answers come to this one, too.
  void NoteAsked(const ReachRequest& request, Time now);
  // By name.
  [[nodiscard]] std::vector<HeardAgent> Heard(Time now) const;

 private:
  struct Known {
    AgentRole role = AgentRole::kOperator;
    std::uint64_t instance = 0;
    Time since{};
    Time last{};
    Arrival arrival{};
    // The shortest that was measured for this client: what is longer waited for something else.
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
