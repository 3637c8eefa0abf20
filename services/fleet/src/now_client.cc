#include "services/fleet/now_client.h"

#include <fmt/format.h>

#include <utility>

#include "services/base/time.h"
#include "services/fleet/telling.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kNowAgain{100};
constexpr milliseconds kNowWait{20};
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
      say_at = now + kNowAgain;
      for (const exchange::NowCommand& command : telling.commands()) {
        const auto said = exchange.Publish(command);
        if (!said && said.error().code != ErrorCode::kUnavailable) {
          return tl::unexpected(said.error());
        }
      }
    }
    for (const exchange::Message& message : exchange.Take(kNowWait)) telling.Hear(message);
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
