#include "services/fleet/now_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include "services/base/time.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using exchange::NowWhom;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kAgain{100};
constexpr milliseconds kWait{20};
// Whoever joins has heard of all who are there by then, usually.
constexpr milliseconds kAllAreHeard{1500};

// Processes in containers have the same number, and thus the same name.
std::uint64_t DrawnNumber() {
  std::random_device random;
  return std::uniform_int_distribution<std::uint64_t>(1)(random);
}

class Telling {
 public:
  Telling(const AgentId& self, exchange::NowOrder order, const std::vector<NowTarget>& targets,
          const std::string& reason)
      : targets_(targets) {
    for (const NowTarget& target : targets) {
      commands_.emplace_back(exchange::NowCommand{.client = self,
                                                  .number = DrawnNumber(),
                                                  .order = order,
                                                  .whom = target.whom,
                                                  .name = target.name,
                                                  .reason = reason});
      if (target.whom == NowWhom::kRobot) words_[target.name].robot = target.name;
    }
  }

  [[nodiscard]] const std::vector<exchange::NowCommand>& commands() const { return commands_; }

  void Hear(const exchange::Message& message) {
    if (const auto* answer = std::get_if<exchange::NowAnswer>(&message)) {
      if (!Answers(*answer)) return;
      words_[answer->agent.value()] = {answer->agent.value(), true, answer->refused,
                                       answer->detail};
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

  [[nodiscard]] bool AllAnswered(milliseconds since) const {
    const bool only_named =
        std::all_of(targets_.begin(), targets_.end(),
                    [](const NowTarget& each) { return each.whom == NowWhom::kRobot; });
    if (!only_named && since < kAllAreHeard) return false;
    return std::all_of(words_.begin(), words_.end(),
                       [](const auto& each) { return each.second.answered; });
  }
  [[nodiscard]] std::vector<RobotsWord> Take() && {
    std::vector<RobotsWord> words;
    for (auto& [name, word] : words_) words.push_back(std::move(word));
    return words;
  }

 private:
  // Another process may be called the same.
  [[nodiscard]] bool Answers(const exchange::NowAnswer& answer) const {
    return std::any_of(commands_.begin(), commands_.end(), [&](const auto& command) {
      return answer.client == command.client && answer.number == command.number;
    });
  }
  [[nodiscard]] bool IsNamed(const std::string& robot) const {
    return std::any_of(targets_.begin(), targets_.end(), [&](const NowTarget& each) {
      return each.whom == NowWhom::kRobot && each.name == robot;
    });
  }
  [[nodiscard]] bool IsMeant(const exchange::AgentStatus& status) const {
    return std::any_of(targets_.begin(), targets_.end(), [&](const NowTarget& each) {
      return each.whom == NowWhom::kAll ||
             (each.whom == NowWhom::kOnRoute && each.name == status.route);
    });
  }

  const std::vector<NowTarget>& targets_;
  std::vector<exchange::NowCommand> commands_;
  std::map<std::string, RobotsWord> words_;
};

}  // namespace

Result<std::vector<RobotsWord>> TellRobots(exchange::RouteExchange& exchange, const AgentId& self,
                                           exchange::NowOrder order,
                                           const std::vector<NowTarget>& targets,
                                           const std::string& reason, milliseconds timeout) {
  Telling telling(self, order, targets, reason);
  const auto began = steady_clock::now();
  auto say_at = began;
  while (true) {
    const auto now = steady_clock::now();
    const auto since = std::chrono::duration_cast<milliseconds>(now - began);
    if (since > timeout || telling.AllAnswered(since)) break;
    if (now >= say_at) {
      say_at = now + kAgain;
      for (const exchange::NowCommand& command : telling.commands()) {
        const auto said = exchange.Publish(command);
        if (!said && said.error().code != ErrorCode::kUnavailable) {
          return tl::unexpected(said.error());
        }
      }
    }
    for (const exchange::Message& message : exchange.Take(kWait)) telling.Hear(message);
  }
  auto words = std::move(telling).Take();
  if (!words.empty()) return words;
  return Fail(
      ErrorCode::kUnavailable,
      "no robot that this is meant for was heard within {:.1f} s: do its agent and this "
      "program have the same --domain and --dds-tag? (Robots are heard while 'trailcast-agent "
      "replay --server' runs.)",
      Seconds(steady_clock::now() - began));
}

std::string WordsText(const std::vector<RobotsWord>& words) {
  std::string text;
  for (const RobotsWord& word : words) {
    text += fmt::format("{}: {}{}\n", word.robot,
                        !word.answered ? "did not answer"
                        : word.refused ? "does not obey: "
                                       : "",
                        word.answered ? word.detail : "");
  }
  return text;
}

std::string WordsJson(const std::vector<RobotsWord>& words) {
  std::string text = "[";
  for (const RobotsWord& word : words) {
    text += fmt::format("{}\n  {{\"robot\": {}, \"answered\": {}, \"obeys\": {}, \"detail\": {}}}",
                        text.size() == 1 ? "" : ",", program::JsonText(word.robot), word.answered,
                        word.answered && !word.refused, program::JsonText(word.detail));
  }
  return text + (words.empty() ? "]\n" : "\n]\n");
}

}  // namespace trailcast::fleet
