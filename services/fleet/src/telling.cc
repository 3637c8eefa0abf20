#include "services/fleet/telling.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "services/base/similar_names.h"
#include "services/fleet/draw.h"
#include "services/mission/orders.h"

namespace trailcast::fleet {
namespace {

using exchange::NowWhom;
using std::chrono::milliseconds;

// A program that joins has usually heard of all robots by then.
constexpr milliseconds kAllAreHeard{1500};

// A robot does not know that it has a queue, so a server's word on that may come after its own.
constexpr milliseconds kServersHaveAnswered{1000};

// Strangers can make names up.
constexpr std::size_t kMostNames = 1024;

}  // namespace

Telling::Telling(const AgentId& self, exchange::NowOrder order, std::vector<NowTarget> targets,
                 const std::string& reason)
    : order_(order), targets_(std::move(targets)) {
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
  } else if (const auto* report = std::get_if<mission::Report>(&message)) {
    const bool is_servers = report->relayed && report->change == 0;
    if (order_ != exchange::NowOrder::kCancel || !is_servers) return;
    if (report->state != mission::State::kCancelled) return;
    std::set<std::string>& dropped = dropped_[report->agent.value()];
    if (dropped.size() < kMostNames) dropped.insert(report->mission);
  } else if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    const bool ended = status->mode == exchange::AgentMode::kStopped;
    const std::string& robot = status->agent.value();
    if (status->role == exchange::AgentRole::kFollower && names_.size() < kMostNames) Note(robot);
    const auto known = words_.find(robot);
    // A robot that has announced its end stands. One that is only no longer heard, because it was
    // killed, may not.
    if (ended && known != words_.end() && !known->second.answered && !IsNamed(robot)) {
      words_.erase(known);
    } else if (status->role == exchange::AgentRole::kFollower && !ended && IsMeant(*status)) {
      Expect(robot, LastSeenText(*status, std::nullopt));
    }
  }
}

void Telling::Expect(const std::string& robot, const std::string& last_known) {
  RobotsWord& word = words_[robot];
  word.robot = robot;
  if (!word.answered) word.detail = last_known;
}

void Telling::Expect(const mission::Record& record) {
  const std::string& robot = record.mission.agent.value();
  if (words_.contains(robot)) return;  // it is heard, which tells more
  const auto routes = mission::RoutesIn(record.mission.orders);
  const bool is_meant = std::any_of(targets_.begin(), targets_.end(), [&](const NowTarget& each) {
    return each.whom == NowWhom::kAll ||
           (each.whom == NowWhom::kOnRoute && routes.contains(each.name));
  });
  if (!is_meant || record.last.change == 0) return;  // it has not taken the mission
  Expect(robot, LastKnownText(record));
}

bool Telling::only_named() const {
  return std::all_of(targets_.begin(), targets_.end(),
                     [](const NowTarget& each) { return each.whom == NowWhom::kRobot; });
}

bool Telling::AllAnswered(milliseconds since) const {
  if (!only_named() && since < kAllAreHeard) return false;
  const bool may_have_queues =
      order_ == exchange::NowOrder::kCancel && since < kServersHaveAnswered;
  return std::all_of(words_.begin(), words_.end(), [&](const auto& each) {
    const RobotsWord& word = each.second;
    return word.answered && (!word.refused || !may_have_queues || dropped_.contains(word.robot));
  });
}

std::vector<RobotsWord> Telling::Words() const {
  std::vector<RobotsWord> words;
  for (const auto& [name, word] : words_) {
    words.push_back(word);
    RobotsWord& last = words.back();
    if (const auto dropped = dropped_.find(name); last.answered && dropped != dropped_.end()) {
      const std::string queue = fmt::format("{} queued mission{} cancelled", dropped->second.size(),
                                            dropped->second.size() == 1 ? "" : "s");
      last.detail = last.refused ? queue : last.detail + "; " + queue;
      last.refused = false;
    }
    last.known = word.answered || names_.contains(name) || !word.detail.empty();
    if (last.known) continue;
    last.detail = "no robot of this name was heard" +
                  DidYouMean(name, std::vector<std::string>(names_.begin(), names_.end()));
  }
  return words;
}

// Another process may have the same name, so the number counts, too.
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
