#include "services/fleet/mission_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "tests/support/await.h"

namespace trailcast::fleet {
namespace {

using mission::Mission;
using mission::Record;
using mission::Report;
using mission::State;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

class MissionClientTest : public testing::Test {
 protected:
  void TearDown() override {
    ending_ = true;
    for (std::thread& peer : peers_) peer.join();
  }
  // Answers each time that it hears the mission.
  void Answering(const exchange::TopicUse& use, std::vector<Report> answers) {
    peers_.emplace_back(
        [this, answers, exchange = std::shared_ptr<exchange::RouteExchange>(bus_.Open(use))] {
          std::size_t at = 0;
          while (!ending_) {
            for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
              if (!std::holds_alternative<Mission>(message)) continue;
              (void)exchange->Publish(answers[std::min(at++, answers.size() - 1)]);
            }
          }
        });
  }
  static Report Of(std::uint32_t change, State state, const std::string& detail = "") {
    return {.agent = AgentId("robot1"),
            .mission = "m1",
            .change = change,
            .state = state,
            .detail = detail,
            .relayed = change == 0};
  }
  Result<Report> Send(const SendWatch& watch = {.timeout = milliseconds(20'000)}) {
    const auto desk = bus_.Open(exchange::SenderTopics());
    return SendMission(*desk,
                       {.agent = AgentId("robot1"),
                        .id = "m1",
                        .client = AgentId("desk"),
                        .orders = "follow hall"},
                       watch)
        .map([](const std::vector<Report>& reports) { return reports.front(); });
  }

  exchange::InProcessBus bus_;
  std::atomic<bool> ending_{false};
  std::vector<std::thread> peers_;
};

TEST_F(MissionClientTest, ReturnsAsSoonAsTheRobotHasAnswered) {
  Answering(exchange::OnDutyTopics(), {Of(1, State::kAccepted)});
  const auto report = Send();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->state, State::kAccepted);
  EXPECT_EQ(ReportText(*report), "robot1: accepted");
}

TEST_F(MissionClientTest, WhereTheRobotIsNotThereItIsKept) {
  Answering(exchange::ServerTopics(), {Of(0, State::kSent)});
  const auto report = Send();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->state, State::kSent);
  EXPECT_THAT(ReportText(*report), HasSubstr("a server keeps it"));
}

TEST_F(MissionClientTest, WatchesItToItsEnd) {
  // A late report of the server is no news after the robot's own.
  Answering(exchange::ServerTopics(),
            {Of(0, State::kSent), Of(2, State::kUnderWay), Of(1, State::kAccepted),
             Of(0, State::kSent), Of(3, State::kArrived)});
  std::vector<std::string> news;
  const auto report =
      Send({.timeout = milliseconds(20'000), .to_its_end = true, .news = [&](const Report& each) {
              news.emplace_back(mission::ToString(each.state));
            }});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->state, State::kArrived);
  EXPECT_THAT(news, ElementsAre("sent", "under way", "arrived"));
}

TEST_F(MissionClientTest, WhatAServerPutsOffIsSentAgain) {
  Answering(exchange::ServerTopics(),
            {Of(0, State::kPutOff, "over quota"), Of(0, State::kPutOff, "over quota"),
             Of(0, State::kSent), Of(0, State::kPutOff, "over quota"), Of(1, State::kArrived)});
  std::vector<std::string> news;
  const auto report =
      Send({.timeout = test::kLongEnough, .to_its_end = true, .news = [&](const Report& each) {
              news.emplace_back(mission::ToString(each.state));
            }});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->state, State::kArrived);
  EXPECT_THAT(news, ElementsAre("sent", "arrived"));
}

TEST_F(MissionClientTest, WhereNobodyAnswersThatIsSaid) {
  const auto report = Send({.timeout = milliseconds(200)});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(report.error().message, HasSubstr("neither robot1 nor a route server answered"));
}

TEST_F(MissionClientTest, AsksForPagesUntilThereAreEnough) {
  peers_.emplace_back([this, exchange = std::shared_ptr<exchange::RouteExchange>(
                                 bus_.Open(exchange::ServerTopics()))] {
    while (!ending_) {
      for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
        const auto* request = std::get_if<exchange::MissionRequest>(&message);
        if (request == nullptr) continue;
        exchange::MissionReply reply{
            .server = AgentId("server"), .client = request->client, .request = request->request};
        const std::uint64_t from = request->query.before == 0 ? 251 : request->query.before;
        for (std::uint64_t i = from - 1; i > 0 && reply.missions.size() < request->query.page_size;
             --i) {
          reply.missions.push_back(
              {.mission = {.agent = AgentId("robot1"),
                           .id = "m" + std::to_string(i),
                           .client = AgentId("desk")},
               .last = {.agent = AgentId("robot1"), .mission = "m" + std::to_string(i)}});
          reply.next = i > 1 ? i : 0;
        }
        (void)exchange->Publish(reply);
      }
    }
  });
  const auto desk = bus_.Open(exchange::HistoryTopics());
  const auto missions = AskForMissions(*desk, AgentId("desk"), {}, 230, milliseconds(20'000));
  ASSERT_TRUE(missions) << missions.error().message;
  ASSERT_EQ(missions->size(), 230U);
  EXPECT_EQ(missions->front().mission.id, "m250");
  EXPECT_EQ(missions->back().mission.id, "m21");
}

TEST(MissionTexts, AreATableForPeopleAndJsonForPrograms) {
  const std::vector<Record> missions{{.mission = {.agent = AgentId("robot1"),
                                                  .id = "m1",
                                                  .client = AgentId("desk-p7"),
                                                  .orders = "follow hall"},
                                      .last = {.agent = AgentId("robot1"),
                                               .mission = "m1",
                                               .state = State::kFailed,
                                               .waits_for = mission::WaitsFor::kPlace,
                                               .detail = "LOST: \"nothing\" is seen"},
                                      .sent_unix_ms = 1000,
                                      .changed_unix_ms = 2000}};
  EXPECT_EQ(
      MissionsTable(missions, 61'000),
      "mission  robot      age  state      orders       sent by  why\n"
      "m1       robot1    60 s  failed     follow hall  desk     LOST: \"nothing\" is seen\n");
  EXPECT_EQ(MissionsTable({}, 0), "no missions\n");
  EXPECT_THAT(
      MissionsJson(missions).dump(),
      HasSubstr(
          R"("sent_by":"desk","state":"failed","task":0,"waits_for":"place","detail":"LOST: \")"));
  EXPECT_EQ(MissionsJson({}).dump(), "[]");
}

TEST(CommandTexts, AreATableForPeopleAndJsonForPrograms) {
  const mission::NowCommand stop{.client = AgentId("desk-p7"), .number = 5, .reason = "smoke"};
  const std::vector<mission::GivenCommand> commands{
      {stop,
       {{.agent = AgentId("robot1"), .client = stop.client, .number = 5, .detail = "stopped"},
        {.agent = AgentId("robot2"),
         .client = stop.client,
         .number = 5,
         .refused = true,
         .detail = "cannot"}},
       1000}};
  EXPECT_EQ(CommandsTable(commands, 61'000),
            "   age  given by  command  whom        why; answers\n"
            "  60 s  desk      stop     all robots  smoke; robot1: stopped; robot2 does not obey: "
            "cannot\n");
  EXPECT_EQ(CommandsTable({}, 0), "no commands\n");
  EXPECT_EQ(CommandsJson({}).dump(), "[]");
  EXPECT_THAT(CommandsJson(commands).dump(),
              HasSubstr(R"("answers":[{"robot":"robot1","obeys":true,"detail":"stopped"},)"));
}

}  // namespace
}  // namespace trailcast::fleet
