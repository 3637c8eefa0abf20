#include "services/fleet/known_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "services/base/similar_names.h"
#include "services/fleet/mission_question.h"
#include "services/mission/address.h"

namespace trailcast::fleet {

Error UnknownRobot(const std::string& name, std::vector<std::string> robots) {
  if (mission::IsGroup(name)) {
    std::transform(robots.begin(), robots.end(), robots.begin(), [](const std::string& robot) {
      return fmt::format("@{}", mission::GroupOf(robot));
    });
    std::sort(robots.begin(), robots.end());
    robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
    return {ErrorCode::kNotFound,
            fmt::format("no robot of group '{}' is heard, nor has a server heard of one{}", name,
                        DidYouMean(name, std::move(robots)))};
  }
  return {
      ErrorCode::kNotFound,
      fmt::format("no robot '{}' is known: neither is one heard, nor has a server ever heard of "
                  "it{}",
                  name, DidYouMean(name, std::move(robots)))};
}

bool HasHeardOf(const exchange::MissionReply& reply, const std::string& robot) {
  const auto& robots = reply.robots;
  return std::any_of(robots.begin(), robots.end(),
                     [&](const std::string& each) { return mission::Means(robot, each); }) ||
         std::any_of(reply.missions.begin(), reply.missions.end(),
                     [](const mission::Record& record) { return record.last.change > 0; });
}

std::optional<Error> FindUnknown(exchange::RouteExchange& exchange, const AgentId& self,
                                 const std::string& robot, std::chrono::milliseconds patience) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kTakeWait{20};
  exchange::MissionRequest request{.client = self};
  request.query.agent = robot;
  MissionQuestion question(std::move(request));
  std::set<std::string> robots;
  bool asked_in_vain = false;
  const auto until = steady_clock::now() + patience;
  for (auto now = steady_clock::now(); now < until; now = steady_clock::now()) {
    question.Ask(exchange, now);
    for (const exchange::Message& message : exchange.Take(kTakeWait)) {
      const auto* status = std::get_if<exchange::AgentStatus>(&message);
      if (status != nullptr && status->role == exchange::AgentRole::kFollower) {
        if (mission::Means(robot, status->agent.value())) return std::nullopt;
        robots.insert(status->agent.value());
      }
      const exchange::MissionReply* answer = question.AnswerIn(message);
      if (answer == nullptr) continue;
      if (HasHeardOf(*answer, robot)) return std::nullopt;
      robots.insert(answer->robots.begin(), answer->robots.end());
      asked_in_vain = true;
    }
  }
  if (!asked_in_vain) return std::nullopt;
  return UnknownRobot(robot, {robots.begin(), robots.end()});
}

}  // namespace trailcast::fleet
