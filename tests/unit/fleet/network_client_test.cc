#include "services/fleet/network_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "tests/support/await.h"

namespace trailcast::fleet {
namespace {

using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class NetworkClientTest : public testing::Test {
 protected:
  ~NetworkClientTest() override {
    ending_ = true;
    if (server_.joinable()) server_.join();
  }
  template <typename Question>
  void Answer(const std::function<exchange::NetworkReply(const Question&)>& answer) {
    server_ = std::thread(
        [this, answer,
         exchange = std::shared_ptr<exchange::RouteExchange>(bus_.Open(exchange::ServerTopics()))] {
          while (!ending_) {
            for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
              const auto* question = std::get_if<Question>(&message);
              if (question == nullptr) continue;
              exchange::NetworkReply reply = answer(*question);
              reply.server = AgentId("server");
              reply.client = question->client;
              reply.request = question->request;
              (void)exchange->Publish(reply);
            }
          }
        });
  }

  exchange::InProcessBus bus_;
  std::atomic<bool> ending_{false};
  std::thread server_;
};

TEST_F(NetworkClientTest, AsksForPageAfterPageAndForAWay) {
  Answer<exchange::NetworkRequest>([](const exchange::NetworkRequest& question) {
    exchange::NetworkReply reply;
    if (question.words.empty()) {
      reply.lines = {fmt::format("route r{} 1", question.first)};
      reply.next = question.first < 2 ? question.first + 1 : 0;
    } else {
      reply.lines = {question.words};
    }
    return reply;
  });
  const auto desk = bus_.Open(exchange::NetworkTopics());
  EXPECT_THAT(AskForNetwork(*desk, AgentId("desk"), test::kLongEnough).value(),
              ElementsAre("route r0 1", "route r1 1", "route r2 1"));
  EXPECT_THAT(AskForWay(*desk, AgentId("desk"), "hall@2", "office@8", test::kLongEnough).value(),
              ElementsAre("way hall@2 office@8"));
}

TEST_F(NetworkClientTest, TellsWhyAChangeWasNotMade) {
  Answer<exchange::NetworkEdit>([](const exchange::NetworkEdit& edit) {
    exchange::NetworkReply reply;
    if (edit.words == "close hall") reply.lines = {edit.words};
    if (reply.lines.empty()) reply.error = "there is no route 'attic'";
    return reply;
  });
  const auto desk = bus_.Open(exchange::JoinerTopics());
  EXPECT_THAT(AskToJoin(*desk, AgentId("desk"), "close hall", test::kLongEnough).value(),
              SizeIs(1));
  const auto refused = AskToJoin(*desk, AgentId("desk"), "close attic", test::kLongEnough);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("server 'server': there is no route 'attic'"));
}

TEST(NetworkTexts, AreForPeopleAndForPrograms) {
  const std::vector<std::string> lines{"route hall 20.00",
                                       "unused join hall@1@12 office@0 both",
                                       "join hall@13 office@0 offset 0.1,-0.2 heading 90.0",
                                       "close hall 3..",
                                       "back hall 1..2",
                                       "limit hall 1..2 speed 0.5",
                                       "narrow hall 1..2",
                                       "lost hall 5..10 2 of 7.5 cost 1.8",
                                       "proposed join hall@3 office@4 both confidence 0.93"};
  EXPECT_THAT(NetworkText(lines),
              AllOf(HasSubstr("route hall 20.00 m\n"),
                    HasSubstr("join hall@1@12 office@0 both   (not used:"),
                    HasSubstr("\nclose hall 3..\n"), HasSubstr("narrow hall 1..2\n"),
                    HasSubstr("lost hall 5..10 2 of 7.5 times lately, a metre counts as 1.8\n")));
  const auto json = NetworkJson(lines);
  EXPECT_EQ(json["routes"].dump(), R"([{"route":"hall","length_m":20.0}])");
  EXPECT_EQ(json["joints"][0].dump(),
            R"({"from":{"route":"hall@1","along_m":12.0},"to":{"route":"office","along_m":0.0},)"
            R"("both":true,"lie":null,"used":false})");
  EXPECT_EQ(json["joints"][1]["lie"].dump(), R"({"ahead_m":0.1,"left_m":-0.2,"turn_rad":1.5708})");
  EXPECT_EQ(json["joints"][1]["used"], true);
  EXPECT_EQ(json["closed"].dump(), R"([{"route":"hall","from_m":3.0,"to_m":null}])");
  EXPECT_EQ(json["backed"].dump(), R"([{"route":"hall","from_m":1.0,"to_m":2.0}])");
  EXPECT_EQ(json["limits"].dump(),
            R"([{"route":"hall","from_m":1.0,"to_m":2.0,"speed":0.5,"cost":1.0}])");
  EXPECT_EQ(json["proposed"].dump(),
            R"([{"from":{"route":"hall","along_m":3.0},"to":{"route":"office","along_m":4.0},)"
            R"("both":true,"lie":null,"confidence":0.93}])");
  EXPECT_EQ(json["lost"].dump(), R"([{"route":"hall","from_m":5.0,"to_m":10.0,"passed":7.5,)"
                                 R"("lost":2.0,"cost":1.8}])");
  EXPECT_EQ(json["names"].dump(), "[]");
  EXPECT_EQ(json["charge"].dump(), "null");
  EXPECT_THAT(NetworkText({"charge below 20 until 90", "charging robot1 charges at dock1"}),
              testing::StrEq("charge below 20 until 90\nrobot1 charges at dock1\n"));
  EXPECT_THAT(NetworkText({}), HasSubstr("no routes are joined"));

  const std::vector<std::string> way{"follow hall 2..12", "follow office ..8.5 speed 0.5"};
  EXPECT_THAT(WayText(way), HasSubstr("follow office ..8.5 speed 0.5\n18.5 m\n"));
  EXPECT_EQ(WayJson(way).dump(), R"({"length_m":18.5,"stretches":[)"
                                 R"({"route":"hall","from_m":2.0,"to_m":12.0,"speed":1.0},)"
                                 R"({"route":"office","from_m":0.0,"to_m":8.5,"speed":0.5}]})");
  EXPECT_EQ(WayJson({"follow hall backwards 5..2", "turn 90", "follow office 1..2"}).dump(),
            R"({"length_m":4.0,"stretches":[)"
            R"({"route":"hall","from_m":5.0,"to_m":2.0,"speed":1.0},)"
            R"({"route":"office","from_m":1.0,"to_m":2.0,"speed":1.0,"turn_rad":1.571}]})");
  EXPECT_EQ(WayText({}), "it is there already\n");
}

TEST_F(NetworkClientTest, WhatPassesIsToldWithWhatToDo) {
  Answer<exchange::NetworkRequest>([](const exchange::NetworkRequest& question) {
    EXPECT_EQ(question.words, "passing bay");
    return exchange::NetworkReply{
        .lines = {"at hall@12.3", "passes office@0.3 join hall@12 office@0 both",
                  "passes ring@7.1 proposed join ring@5 hall@10.2 both confidence 0.93"}};
  });
  const auto desk = bus_.Open(exchange::NetworkTopics());
  const auto passings = AskWhatPasses(*desk, AgentId("desk"), "bay", test::kLongEnough);
  ASSERT_TRUE(passings) << passings.error().message;
  EXPECT_EQ(PassingText(*passings),
            "hall@12.3\n"
            "  office@0.3  join hall@12 office@0 both\n"
            "  ring@7.1    proposed join ring@5 hall@10.2 both confidence 0.93\n"
            "what is proposed is no way until somebody has looked: 'trailcast network confirm "
            "ring@5 hall@10.2', or refuse\n");
  EXPECT_THAT(PassingJson(*passings).dump(),
              AllOf(HasSubstr(R"({"place":{"route":"hall","along_m":12.3},"passing":[{"at":)"
                              R"({"route":"office","along_m":0.3},"joined":true,"confidence":null,)"
                              R"("joint":{"from":{"route":"hall","along_m":12.0},)"),
                    HasSubstr(R"("joined":false,"confidence":0.93,)")));
  EXPECT_THAT(PassingText({.place = {"hall", 3.0}}),
              testing::StartsWith("no other route is known to pass at hall@3: where one does, "
                                  "'trailcast network join hall@3 ROUTE@METRES' says so"));
}

TEST_F(NetworkClientTest, ChangesAreShownTheNewestFirst) {
  Answer<exchange::NetworkRequest>([](const exchange::NetworkRequest& question) {
    exchange::NetworkReply reply;
    EXPECT_EQ(question.words, "changes since 5000");
    reply.lines = {network::KeptSince(3000), "changed 6000 desk close hall 3..7",
                   "changed 7000 - activated hall@3"};
    return reply;
  });
  const auto desk = bus_.Open(exchange::NetworkTopics());
  const auto history = AskForChanges(*desk, AgentId("desk"), 5000, test::kLongEnough);
  ASSERT_TRUE(history) << history.error().message;
  EXPECT_THAT(ChangesText(*history, 5000, 100),
              testing::MatchesRegex(".*1970-01-01.*  -     activated hall@3\n.*  desk  close hall "
                                    "3..7\n"));
  EXPECT_THAT(ChangesText(*history, 2000, 1),
              AllOf(HasSubstr("activated hall@3\n1 of 2 changes; --limit shows more\nkept since "),
                    testing::Not(HasSubstr("close"))));
  EXPECT_THAT(ChangesText({.kept_since_unix_ms = 3000}, 5000, 100),
              testing::StartsWith("nothing was changed since "));
  EXPECT_EQ(ChangesJson(*history, 1).dump(),
            R"({"kept_since_unix_ms":3000,"total":2,"changes":[{"at_unix_ms":7000,"by":null,)"
            R"("what":"activated hall@3","routes":["hall"]}]})");
}

TEST(ChangesJsonTest, TellsOfTheRoutesAloneThatAreAskedFor) {
  const network::History history{.changes = {{1000, "desk", "close hall 3..7"},
                                             {2000, "desk", "renamed hall to aisle"},
                                             {3000, "desk", "close 0a1b2c3"},
                                             {4000, "desk", "close hall 1..2"}}};
  using Words = std::vector<std::string>;
  for (const auto& [of, total] :
       {std::pair(Words{"aisle"}, 2), std::pair(Words{"hall"}, 1),
        std::pair(Words{"0a1b2c3d4e5f60718293a4b5c6d7e8f9"}, 1),
        std::pair(Words{"hall", "aisle"}, 3), std::pair(Words{"attic"}, 0)}) {
    EXPECT_EQ(ChangesJson(history, 1, of)["total"], total) << of.front();
  }
}

}  // namespace
}  // namespace trailcast::fleet
