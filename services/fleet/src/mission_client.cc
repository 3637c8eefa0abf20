#include "services/fleet/mission_client.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/base/process_name.h"
#include "services/base/unix_time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/ask.h"
#include "services/fleet/draw.h"
#include "services/fleet/sending.h"
#include "services/program/json.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{50};

// Asks for page after page, until there are `limit` records or no more.
template <typename Record>
Result<std::vector<Record>> AskForAll(exchange::RouteExchange& exchange,
                                      exchange::MissionRequest question,
                                      std::vector<Record> exchange::MissionReply::*records,
                                      std::size_t limit, milliseconds timeout) {
  std::vector<Record> all;
  while (true) {
    question.query.page_size =
        static_cast<std::uint32_t>(std::min(limit - all.size(), exchange::kMaxMissionsPerReply));
    question.request = DrawNumber();
    auto reply =
        Ask<exchange::MissionReply>(exchange, question.client, question.request, question, timeout);
    if (!reply) return tl::unexpected(reply.error());
    std::vector<Record>& page = (*reply).*records;
    std::move(page.begin(), page.end(), std::back_inserter(all));
    question.query.before = reply->next;
    if (reply->next == 0 || all.size() >= limit) return all;
  }
}

std::string WhomText(const mission::NowCommand& command) {
  if (command.whom == mission::NowWhom::kAll) return "all robots";
  return command.whom == mission::NowWhom::kOnRoute ? "route " + command.name : command.name;
}

}  // namespace

Result<std::vector<mission::Report>> SendMission(exchange::RouteExchange& exchange,
                                                 const mission::Mission& mission,
                                                 const SendWatch& watch) {
  SendingToAll sending(mission);
  const auto over = [&](milliseconds since) {
    return watch.to_its_end && sending.heard() ? sending.Ended(since)
                                               : sending.Answered(since, watch.timeout);
  };
  const auto began = steady_clock::now();
  auto say_at = began;
  while (!watch.stop()) {
    const auto now = steady_clock::now();
    if (over(std::chrono::duration_cast<milliseconds>(now - began))) break;
    if (now >= say_at) {
      say_at = now + sending.SayAgain();
      const auto said = exchange.Publish(mission);
      if (!said && said.error().code != ErrorCode::kUnavailable) {
        return tl::unexpected(said.error());
      }
    }
    for (const exchange::Message& message : exchange.Take(kWait)) {
      if (const auto news = sending.Hear(message)) watch.news(*news);
    }
  }
  return sending.Outcome(watch.timeout);
}

Result<std::vector<mission::Record>> AskForMissions(exchange::RouteExchange& exchange,
                                                    const AgentId& client, mission::Query query,
                                                    std::size_t limit, milliseconds timeout) {
  return AskForAll(exchange, {.client = client, .query = std::move(query)},
                   &exchange::MissionReply::missions, limit, timeout);
}

Result<std::vector<mission::GivenCommand>> AskForCommands(exchange::RouteExchange& exchange,
                                                          const AgentId& client,
                                                          mission::Query query, std::size_t limit,
                                                          milliseconds timeout) {
  return AskForAll(exchange, {.client = client, .commands = true, .query = std::move(query)},
                   &exchange::MissionReply::commands, limit, timeout);
}

void SortAsQueues(std::vector<mission::Record>& missions) {
  std::reverse(missions.begin(), missions.end());
  const auto place = [](const mission::Record& record) {
    return std::pair(record.mission.agent, record.last.state == mission::State::kSent);
  };
  std::stable_sort(missions.begin(), missions.end(),
                   [&](const auto& one, const auto& other) { return place(one) < place(other); });
}

std::string ReportText(const mission::Report& report) {
  if (report.state == mission::State::kSent) {
    return fmt::format("{}: sent: a server keeps it, and hands it over in its turn{}{}",
                       report.agent.value(), report.detail.empty() ? "" : "; ", report.detail);
  }
  return fmt::format("{}: {}{}{}", report.agent.value(), mission::ToString(report.state),
                     report.detail.empty() ? "" : ": ", report.detail);
}

program::Json ReportJson(const mission::Report& report) {
  return {{"mission", report.mission},
          {"robot", report.agent.value()},
          {"state", mission::ToString(report.state)},
          {"task", report.task},
          {"waits_for", mission::ToString(report.waits_for)},
          {"detail", report.detail}};
}

program::Json MissionJson(const mission::Record& record) {
  const mission::Mission& mission = record.mission;
  return {{"mission", mission.id},
          {"robot", mission.agent.value()},
          {"orders", mission.orders},
          {"sent_by", WithoutProcess(mission.client.value())},
          {"state", mission::ToString(record.last.state)},
          {"task", record.last.task},
          {"waits_for", mission::ToString(record.last.waits_for)},
          {"detail", record.last.detail},
          {"sent_unix_ms", record.sent_unix_ms},
          {"changed_unix_ms", record.changed_unix_ms}};
}

std::string MissionsTable(const std::vector<mission::Record>& missions, std::int64_t now_unix_ms) {
  if (missions.empty()) return "no missions\n";
  std::size_t id = 7;
  std::size_t robot = 5;
  std::size_t orders = 6;
  std::size_t by = 7;
  for (const mission::Record& record : missions) {
    id = std::max(id, record.mission.id.size());
    robot = std::max(robot, record.mission.agent.value().size());
    orders = std::max(orders, record.mission.orders.size());
    by = std::max(by, WithoutProcess(record.mission.client.value()).size());
  }
  const auto line = [&](const auto&... each) {
    return fmt::format("{:<{}}  {:<{}}  {:>6}  {:<9}  {:<{}}  {:<{}}  {}\n", each...);
  };
  std::string text =
      line("mission", id, "robot", robot, "age", "state", "orders", orders, "sent by", by, "why");
  for (const mission::Record& record : missions) {
    text += line(record.mission.id, id, record.mission.agent.value(), robot,
                 Age(now_unix_ms - record.sent_unix_ms), mission::ToString(record.last.state),
                 record.mission.orders, orders, WithoutProcess(record.mission.client.value()), by,
                 record.last.detail);
  }
  return text;
}

program::Json MissionsJson(const std::vector<mission::Record>& missions) {
  auto list = program::Json::array();
  for (const mission::Record& record : missions) list.push_back(MissionJson(record));
  return list;
}

std::string CommandsTable(const std::vector<mission::GivenCommand>& commands,
                          std::int64_t now_unix_ms) {
  if (commands.empty()) return "no commands\n";
  std::size_t by = 8;
  std::size_t whom = 5;
  for (const mission::GivenCommand& given : commands) {
    by = std::max(by, WithoutProcess(given.command.client.value()).size());
    whom = std::max(whom, WhomText(given.command).size());
  }
  const auto line = [&](const auto&... each) {
    return fmt::format("{:>6}  {:<{}}  {:<7}  {:<{}}  {}\n", each...);
  };
  std::string text = line("age", "given by", by, "command", "whom", whom, "why; answers");
  for (const mission::GivenCommand& given : commands) {
    const mission::NowCommand& command = given.command;
    std::string words = command.reason;
    for (const mission::NowAnswer& answer : given.answers) {
      words += fmt::format("{}{}{}: {}", words.empty() ? "" : "; ", answer.agent.value(),
                           answer.refused ? " does not obey" : "", answer.detail);
    }
    text += line(Age(now_unix_ms - given.given_unix_ms), WithoutProcess(command.client.value()), by,
                 mission::ToString(command.order), WhomText(command), whom, words);
  }
  return text;
}

program::Json CommandsJson(const std::vector<mission::GivenCommand>& commands) {
  auto list = program::Json::array();
  for (const mission::GivenCommand& given : commands) {
    auto answers = program::Json::array();
    for (const mission::NowAnswer& answer : given.answers) {
      answers.push_back(
          {{"robot", answer.agent.value()}, {"obeys", !answer.refused}, {"detail", answer.detail}});
    }
    list.push_back({{"given_by", WithoutProcess(given.command.client.value())},
                    {"command", mission::ToString(given.command.order)},
                    {"whom", WhomText(given.command)},
                    {"reason", given.command.reason},
                    {"given_unix_ms", given.given_unix_ms},
                    {"answers", std::move(answers)}});
  }
  return list;
}

}  // namespace trailcast::fleet
