#include "services/fleet/telling.h"

#include <algorithm>
#include <utility>

#include "services/fleet/draw.h"

namespace trailcast::fleet {
namespace {

using exchange::NowWhom;
using std::chrono::milliseconds;

// Whoever joins has heard of all who are there by then, usually.
constexpr milliseconds kAllAreHeard{1500};

}  // namespace

Telling::Telling(const AgentId& self, exchange::NowOrder order, std::vector<NowTarget> targets,
                 const std::string& reason)
    : targets_(std::move(targets)) {
  for (const NowTarget& target : targets_) {
    commands_.emplace_back(exchange::NowCommand{.client = self,
                                                .number = DrawNumber(),
                                                .order = order,
                                                .whom = target.whom,
                                                .name = target.name,
                                                .reason = reason});
    if (target.whom == NowWhom::kRobot) words_[target.name].robot = target.name;
  }
}

void Telling::Hear(const exchange::Message& message) {
  if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
    if (!Answers(*answer)) return;
    words_[answer->agent.value()] = {answer->agent.value(), true, answer->refused, answer->detail};
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    const bool ended = status->mode == exchange::AgentMode::kStopped;
    if (status->role == exchange::AgentRole::kFollower && !ended && IsMeant(*status)) {
      words_[status->agent.value()].robot = status->agent.value();
    }
  } else if (const auto* gone = std::get_if<exchange::AgentGone>(&message)) {
    const auto known = words_.find(gone->agent.value());
    if (known != words_.end() && !known->second.answered && !IsNamed(known->first)) {
      words_.erase(known);
    }
  }
}

bool Telling::AllAnswered(milliseconds since) const {
  const bool only_named = std::all_of(targets_.begin(), targets_.end(), [](const NowTarget& each) {
    return each.whom == NowWhom::kRobot;
  });
  if (!only_named && since < kAllAreHeard) return false;
  return std::all_of(words_.begin(), words_.end(),
                     [](const auto& each) { return each.second.answered; });
}

std::vector<RobotsWord> Telling::Words() const {
  std::vector<RobotsWord> words;
  for (const auto& [name, word] : words_) words.push_back(word);
  return words;
}

// Another process may be called the same.
bool Telling::Answers(const exchange::NowAnswer& answer) const {
  return std::any_of(commands_.begin(), commands_.end(), [&](const auto& command) {
    return answer.client == command.client && answer.number == command.number;
  });
}

bool Telling::IsNamed(const std::string& robot) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const NowTarget& each) {
    return each.whom == NowWhom::kRobot && each.name == robot;
  });
}

bool Telling::IsMeant(const exchange::AgentStatus& status) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const NowTarget& each) {
    return each.whom == NowWhom::kAll ||
           (each.whom == NowWhom::kOnRoute && each.name == status.route);
  });
}

}  // namespace trailcast::fleet
