#include "services/fleet/now_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/mission_question.h"
#include "services/fleet/telling.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kNowAgain{100};
constexpr milliseconds kNowWait{20};

// A program that has just joined does not hear robots that are silent, but servers know which are
// on missions.
exchange::MissionRequest WhoIsOnAMission(const AgentId& self) {
  exchange::MissionRequest request{.client = self};
  request.query.page_size = exchange::kMaxMissionsPerReply;
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    const bool has_ended = mission::HasEnded(static_cast<mission::State>(i));
    request.query.states |= has_ended ? 0U : 1U << i;
  }
  return request;
}

}  // namespace

Result<std::vector<RobotsWord>> TellRobots(exchange::RouteExchange& exchange, const AgentId& self,
                                           exchange::NowOrder order,
                                           const std::vector<NowTarget>& targets,
                                           const std::string& reason, milliseconds timeout) {
  Telling telling(self, order, targets, reason);
  MissionQuestion on_mission(WhoIsOnAMission(self));
  bool asks = !telling.only_named();
  const auto began = steady_clock::now();
  auto say_at = began;
  while (true) {
    const auto now = steady_clock::now();
    const auto since = std::chrono::duration_cast<milliseconds>(now - began);
    if (since > timeout || telling.AllAnswered(since)) break;
    if (now >= say_at) {
      say_at = now + kNowAgain;
      for (const exchange::NowCommand& command : telling.commands()) {
        const auto said = exchange.Publish(command);
        if (!said && said.error().code != ErrorCode::kUnavailable) {
          return tl::unexpected(said.error());
        }
      }
    }
    if (asks) on_mission.Ask(exchange, now);
    for (const exchange::Message& message : exchange.Take(kNowWait)) {
      telling.Hear(message);
      const exchange::MissionReply* answer = on_mission.AnswerIn(message);
      if (answer == nullptr) continue;
      asks = false;
      for (const mission::Record& record : answer->missions) telling.Expect(record);
    }
  }
  auto words = telling.Words();
  if (!words.empty()) return words;
  return Fail(
      ErrorCode::kUnavailable,
      "no robot that this is meant for was heard within {:.1f} s: do its agent and this "
      "program have the same --domain and --dds-tag? (Robots are heard while 'trailcast-agent "
      "replay --server' runs.)",
      Seconds(steady_clock::now() - began));
}

Obeyed ObeyedBy(const std::vector<RobotsWord>& words) {
  const auto any = [&](auto is) { return std::any_of(words.begin(), words.end(), is); };
  if (any([](const RobotsWord& word) { return !word.answered; })) return Obeyed::kUnanswered;
  if (any([](const RobotsWord& word) { return word.refused; })) return Obeyed::kNotByAll;
  return Obeyed::kByAll;
}

std::string LastSeenText(const exchange::AgentStatus& status, std::optional<milliseconds> ago) {
  const bool drives = status.mode == exchange::AgentMode::kReplaying ||
                      status.mode == exchange::AgentMode::kTeaching;
  const std::string doing = status.speed_mps != 0.0
                                ? fmt::format("moving at {:.2f} m/s", std::abs(status.speed_mps))
                            : drives ? "driving"
                                     : "standing";
  if (!ago) return "last seen " + doing;
  return fmt::format("last seen {} ago, {}", Age(ago->count()), doing);
}

std::string LastKnownText(const mission::Record& record) {
  return fmt::format("last known on its mission '{}', {}", record.mission.orders,
                     mission::ToString(record.last.state));
}

std::string StandText(const std::vector<RobotsWord>& words) {
  std::size_t stand = 0;
  std::string others;
  for (const RobotsWord& word : words) {
    if (word.answered && !word.refused) {
      ++stand;
      continue;
    }
    others += fmt::format("{}{} {}{}", others.empty() ? "" : "; ", word.robot,
                          word.answered ? "does not obey: "
                          : word.known  ? "did not answer and may be moving"
                                        : "did not answer",
                          word.answered         ? word.detail
                          : word.detail.empty() ? ""
                                                : " (" + word.detail + ")");
  }
  if (others.empty() && stand == 1) return words.front().robot + " stands.";
  if (others.empty()) return fmt::format("All {} robots stand.", stand);
  return fmt::format("{} of {} robots stand. {}.", stand, words.size(), others);
}

std::string WordsText(const std::vector<RobotsWord>& words) {
  std::string text;
  for (const RobotsWord& word : words) {
    const char* says = word.refused ? "does not obey: " : "";
    if (!word.answered) says = word.detail.empty() ? "did not answer" : "did not answer: ";
    text += fmt::format("{}: {}{}\n", word.robot, says, word.detail);
  }
  return text;
}

program::Json WordJson(const RobotsWord& word) {
  return {{"robot", word.robot},
          {"answered", word.answered},
          {"obeys", word.answered && !word.refused},
          {"detail", word.detail}};
}

program::Json WordsJson(const std::vector<RobotsWord>& words) {
  auto list = program::Json::array();
  for (const RobotsWord& word : words) list.push_back(WordJson(word));
  return list;
}

}  // namespace trailcast::fleet
