#include "services/fleet/now_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/fleet/telling.h"
#include "services/program/presence.h"
#include "tests/support/await.h"

namespace trailcast::fleet {
namespace {

using exchange::AgentMode;
using exchange::NowOrder;
using exchange::NowWhom;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

// Robots on a bus, of which some answer, perhaps only once they have been told for a while.
class NowClientTest : public testing::Test {
 protected:
  void TearDown() override {
    ending_ = true;
    for (std::thread& robot : robots_) robot.join();
  }
  void Robot(const std::string& name, const std::string& route, bool answers, bool refuses = false,
             int deaf_to = 0) {
    robots_.emplace_back([this, name, route, answers, refuses, deaf_to,
                          exchange = std::shared_ptr<exchange::RouteExchange>(
                              bus_.Open(program::WithAgents(exchange::FollowerTopics())))] {
      exchange::AgentStatus status;
      status.agent = AgentId(name);
      status.role = exchange::AgentRole::kFollower;
      status.mode = AgentMode::kReplaying;
      status.route = route;
      (void)exchange->Publish(status);
      while (!ending_) {
        for (const exchange::Message& message : exchange->Take(milliseconds(10))) {
          const auto* command = std::get_if<exchange::NowCommand>(&message);
          if (command == nullptr || !answers || ++heard_ <= deaf_to) continue;
          (void)exchange->Publish(exchange::NowAnswer{.agent = AgentId(name),
                                                      .client = command->client,
                                                      .number = command->number,
                                                      .refused = refuses,
                                                      .detail = "says " + name});
        }
      }
    });
  }
  Result<std::vector<RobotsWord>> Tell(const std::vector<NowTarget>& targets,
                                       milliseconds timeout = 2 * test::kLongEnough) {
    const auto desk = bus_.Open(exchange::DispatcherTopics());
    return TellRobots(*desk, AgentId("desk"), NowOrder::kPause, targets, "why", timeout);
  }

  exchange::InProcessBus bus_;
  std::atomic<bool> ending_{false};
  std::atomic<int> heard_{0};
  std::vector<std::thread> robots_;
};

TEST_F(NowClientTest, ReturnsAsSoonAsTheRobotThatIsNamedHasAnswered) {
  Robot("robot1", "hall", true);
  const auto began = std::chrono::steady_clock::now();
  const auto words = Tell({{NowWhom::kRobot, "robot1"}});
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_EQ(WordsText(*words), "robot1: says robot1\n");
  EXPECT_LT(std::chrono::steady_clock::now() - began, test::kLongEnough);
}

TEST_F(NowClientTest, OfAllItNamesThoseWhoDoNotAnswer) {
  Robot("robot1", "hall", true);
  Robot("robot2", "yard", false);
  Robot("robot3", "yard", true, true);
  const auto words = Tell({{NowWhom::kAll, ""}}, milliseconds(4000));
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_THAT(*words,
              ElementsAre(Field(&RobotsWord::robot, "robot1"), Field(&RobotsWord::robot, "robot2"),
                          Field(&RobotsWord::robot, "robot3")));
  EXPECT_EQ(WordsText(*words),
            "robot1: says robot1\nrobot2: did not answer: last seen driving\n"
            "robot3: does not obey: says robot3\n");
  EXPECT_EQ(WordsJson(*words)[1].dump(),
            R"({"robot":"robot2","answered":false,"obeys":false,"detail":"last seen driving"})");
}

TEST_F(NowClientTest, OfAllItNamesWhoIsSilentAndOnAMissionByAServer) {
  const auto server = bus_.Open(exchange::ServerTopics());
  std::thread answering([&] {
    while (!ending_) {
      for (const exchange::Message& message : server->Take(milliseconds(10))) {
        const auto* asked = std::get_if<exchange::MissionRequest>(&message);
        if (asked == nullptr) continue;
        exchange::MissionReply reply{
            .server = AgentId("barn"), .client = asked->client, .request = asked->request};
        for (const auto& [robot, change] : {std::pair{"robot1", 3U}, {"robot2", 4U}, {"far", 0U}}) {
          reply.missions.push_back(
              {.mission = {.agent = AgentId(robot),
                           .id = "trip",
                           .client = AgentId("other"),
                           .orders = "follow hall"},
               .last = {.agent = AgentId(robot),
                        .mission = "trip",
                        .change = change,
                        .state = change > 0 ? mission::State::kUnderWay : mission::State::kSent}});
        }
        (void)server->Publish(reply);
      }
    }
  });
  Robot("robot1", "hall", true);
  const auto all = Tell({{NowWhom::kAll, ""}}, milliseconds(4000));
  const auto on_hall = Tell({{NowWhom::kOnRoute, "hall"}}, milliseconds(4000));
  const auto on_yard = Tell({{NowWhom::kOnRoute, "yard"}}, milliseconds(2000));
  ending_ = true;
  answering.join();
  ASSERT_TRUE(all) << all.error().message;
  EXPECT_EQ(WordsText(*all),
            "robot1: says robot1\n"
            "robot2: did not answer: last known on its mission 'follow hall', under way\n");
  ASSERT_TRUE(on_hall) << on_hall.error().message;
  EXPECT_THAT(WordsText(*on_hall), HasSubstr("robot2"));
  ASSERT_TRUE(on_yard) << on_yard.error().message;
  EXPECT_THAT(WordsText(*on_yard), testing::Not(HasSubstr("robot2"))) << "it is on hall";
}

TEST(Telling, ACancellationAlsoTellsWhatServersHaveDroppedFromQueues) {
  Telling telling(AgentId("desk"), NowOrder::kCancel,
                  {{NowWhom::kRobot, "robot1"}, {NowWhom::kRobot, "robot2"}}, "");
  const auto answer = [&](std::size_t which, bool refused, const std::string& detail) {
    const exchange::NowCommand& command = telling.commands()[which];
    telling.Hear(exchange::NowAnswer{.agent = AgentId(command.name),
                                     .client = command.client,
                                     .number = command.number,
                                     .refused = refused,
                                     .detail = detail});
  };
  const auto dropped = [&](const std::string& robot, const std::string& id) {
    telling.Hear(mission::Report{.agent = AgentId(robot),
                                 .mission = id,
                                 .state = mission::State::kCancelled,
                                 .relayed = true});
  };
  answer(0, true, "has no mission to cancel");
  answer(1, false, "mission cancelled");
  EXPECT_FALSE(telling.AllAnswered(milliseconds(500))) << "a server may have a queue";
  EXPECT_TRUE(telling.AllAnswered(milliseconds(1500)));
  EXPECT_EQ(ObeyedBy(telling.Words()), Obeyed::kNotByAll) << "there was none";
  dropped("robot1", "m1");
  dropped("robot1", "m1");
  dropped("robot2", "m2");
  dropped("robot2", "m3");
  EXPECT_TRUE(telling.AllAnswered(milliseconds(500)));
  EXPECT_EQ(ObeyedBy(telling.Words()), Obeyed::kByAll);
  EXPECT_EQ(telling.Words()[0].detail, "1 queued mission cancelled");
  EXPECT_EQ(telling.Words()[1].detail, "mission cancelled; 2 queued missions cancelled");
}

TEST(Telling, WhoIsHeardNoMoreMayBeMovingAndWhoHasEndedIsNot) {
  Telling telling(AgentId("desk"), NowOrder::kStop, {{NowWhom::kAll, ""}}, "");
  for (const char* name : {"ended", "killed"}) {
    exchange::AgentStatus status;
    status.agent = AgentId(name);
    status.instance = 7;
    status.role = exchange::AgentRole::kFollower;
    status.mode = AgentMode::kReplaying;
    status.speed_mps = 0.4;
    telling.Hear(status);
    status.mode = AgentMode::kStopped;
    if (std::string_view(name) == "ended") telling.Hear(status);
    telling.Hear(exchange::AgentGone{AgentId(name), 7});
  }
  EXPECT_EQ(WordsText(telling.Words()), "killed: did not answer: last seen moving at 0.40 m/s\n");
}

TEST(NowWords, AStopHasDoneItsWorkOnlyIfAllHaveAnswered) {
  const RobotsWord stands{"robot1", true, false, "stopped"};
  const RobotsWord also{"robot2", true, false, "stopped"};
  const RobotsWord disobeys{"robot3", true, true, "does not know this command"};
  const RobotsWord silent{"robot4", false, false, "last seen 5 s ago, moving at 0.40 m/s"};
  EXPECT_EQ(ObeyedBy({stands, also}), Obeyed::kByAll);
  EXPECT_EQ(ObeyedBy({stands, disobeys}), Obeyed::kNotByAll);
  EXPECT_EQ(ObeyedBy({disobeys, silent}), Obeyed::kUnanswered);
  EXPECT_EQ(StandText({stands}), "robot1 stands.");
  EXPECT_EQ(StandText({stands, also}), "All 2 robots stand.");
  EXPECT_EQ(
      StandText({stands, also, silent}),
      "2 of 3 robots stand. robot4 did not answer and may be moving (last seen 5 s ago, moving "
      "at 0.40 m/s).");
  EXPECT_EQ(StandText({stands, disobeys}),
            "1 of 2 robots stand. robot3 does not obey: does not know this command.");
}

TEST_F(NowClientTest, SaysItAgainUntilItIsAnswered) {
  Robot("robot1", "hall", true, false, 3);
  const auto words = Tell({{NowWhom::kRobot, "robot1"}});
  ASSERT_TRUE(words);
  EXPECT_EQ(heard_, 4);
  EXPECT_EQ(WordsText(*words), "robot1: says robot1\n");
}

TEST_F(NowClientTest, WhoIsNamedAndNotThereDidNotAnswer) {
  const auto words = Tell({{NowWhom::kRobot, "nobody"}}, milliseconds(300));
  ASSERT_TRUE(words);
  EXPECT_EQ(WordsText(*words), "nobody: did not answer: no robot of this name was heard\n");
  EXPECT_FALSE(words->front().known);
}

TEST_F(NowClientTest, WhoseNameWasMistypedIsToldWhatItMayHaveBeen) {
  Robot("robot1", "hall", true);
  std::vector<RobotsWord> words;
  test::Await(
      [&] {
        words = Tell({{NowWhom::kRobot, "robot1"}, {NowWhom::kRobot, "robto1"}}, milliseconds(300))
                    .value_or(std::vector<RobotsWord>{});
        return words.size() == 2 && words[0].answered && !words[1].detail.ends_with("heard");
      },
      "the robot to be heard");
  EXPECT_EQ(words[1].detail, "no robot of this name was heard; did you mean 'robot1'?");
}

TEST_F(NowClientTest, TakesNoAnswerToWhatAnotherProcessOfItsNameSaid) {
  const auto robot = bus_.Open(exchange::FollowerTopics());
  std::thread other([&] {
    while (!ending_) {
      (void)robot->Publish(exchange::NowAnswer{
          .agent = AgentId("robot1"), .client = AgentId("desk"), .number = 1, .detail = "old"});
      std::this_thread::yield();
    }
  });
  const auto words = Tell({{NowWhom::kRobot, "robot1"}}, milliseconds(500));
  ending_ = true;
  other.join();
  ASSERT_TRUE(words);
  EXPECT_EQ(WordsText(*words), "robot1: did not answer: no robot of this name was heard\n");
}

TEST_F(NowClientTest, WhereNobodyIsHeardThatIsSaid) {
  const auto words = Tell({{NowWhom::kOnRoute, "hall"}}, milliseconds(300));
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(words.error().message, HasSubstr("no robot that this is meant for was heard"));
}

}  // namespace
}  // namespace trailcast::fleet
