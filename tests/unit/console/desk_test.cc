#include "services/console/desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <latch>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "services/exchange/in_process_exchange.h"
#include "services/program/presence.h"
#include "tests/support/await.h"

namespace trailcast::console {
namespace {

using exchange::NowOrder;
using exchange::NowWhom;
using std::chrono::milliseconds;
using testing::HasSubstr;

// Throws once a command was told.
class ThrowingExchange final : public exchange::RouteExchange {
 public:
  Result<void> Publish(const exchange::Message& message) override {
    told_ |= std::holds_alternative<exchange::NowCommand>(message);
    return {};
  }
  std::vector<exchange::Message> Take(milliseconds /*max_wait*/) override {
    if (told_) throw std::runtime_error("out of memory");
    std::this_thread::sleep_for(milliseconds(1));
    return {};
  }
  Result<void> Listen(exchange::Topic /*topic*/,
                      const std::set<route::RouteKey>& /*routes*/) override {
    return {};
  }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

 private:
  bool told_ = false;
};

TEST(Desk, WhoseThreadThrowsEndsAndSaysWhy) {
  Desk desk(AgentId("desk"), std::make_unique<ThrowingExchange>());
  EXPECT_FALSE(desk.failed());
  const auto told = desk.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, "");
  ASSERT_FALSE(told) << "nobody knows whether the robot stands";
  EXPECT_THAT(told.error().message, HasSubstr("out of memory"));
  EXPECT_TRUE(desk.closed());
  ASSERT_TRUE(desk.failed());
  EXPECT_THAT(desk.failed()->message, HasSubstr("the console's link to the fleet has failed"));
  EXPECT_FALSE(desk.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, ""));
}

class DeskTest : public testing::Test {
 protected:
  exchange::InProcessBus bus_;
  std::unique_ptr<exchange::RouteExchange> robot_ =
      bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  // Robots and servers have time to answer, which nobody waits for who is answered.
  Desk desk_{
      AgentId("desk"), bus_.Open(ConsoleTopics()),
      Desk::Options{.answer_within = milliseconds(20'000), .reply_within = milliseconds(20'000)}};
  // Where nobody answers, or looks.
  Desk hasty_{AgentId("hasty"), bus_.Open(ConsoleTopics()),
              Desk::Options{.answer_within = milliseconds(500),
                            .reply_within = milliseconds(500),
                            .looks_on = milliseconds(100)}};

  // The first of this kind that the robot hears.
  template <typename Message>
  Message Heard() {
    std::optional<Message> heard;
    test::Await(
        [&] {
          for (exchange::Message& message : robot_->Take(milliseconds(100))) {
            auto* wanted = std::get_if<Message>(&message);
            if (wanted != nullptr && !heard) heard = *wanted;
          }
          return heard.has_value();
        },
        "what the robot is told");
    return heard.value_or(Message{});
  }
};

TEST_F(DeskTest, AnOrderBringsBackWhatTheRobotAnswers) {
  auto words = std::async(std::launch::async, [&] {
    return desk_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "rain");
  });
  const auto command = Heard<exchange::NowCommand>();
  EXPECT_EQ(command.reason, "rain");
  ASSERT_TRUE(robot_->Publish(exchange::NowAnswer{.agent = AgentId("robot1"),
                                                  .client = command.client,
                                                  .number = command.number,
                                                  .detail = "paused"}));
  const auto told = words.get();
  ASSERT_TRUE(told) << told.error().message;
  EXPECT_TRUE(told->front().answered);
  EXPECT_EQ(told->front().detail, "paused");
}

TEST_F(DeskTest, WhoDoesNotAnswerIsNamed) {
  const auto told = hasty_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "");
  ASSERT_TRUE(told);
  EXPECT_FALSE(told->front().answered);
  const auto all = hasty_.Tell(NowOrder::kStop, {NowWhom::kAll, ""}, "");
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(all.error().message, HasSubstr("no robot is heard"));
  const auto sent = hasty_.Send({.agent = AgentId("robot1"), .id = "trip", .orders = "wait 1"});
  ASSERT_FALSE(sent);
  EXPECT_THAT(sent.error().message, HasSubstr("neither robot1 nor a route server"));
  EXPECT_FALSE(hasty_.Missions({}));
}

TEST_F(DeskTest, AStopToAllNamesWhoIsSilentAndIsSaidUntilItAnswers) {
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kReplaying;
  status.speed_mps = 0.4;
  ASSERT_TRUE(robot_->Publish(status));
  const auto robot_shown = [&] {
    const auto news = hasty_.See(0, test::kLongEnough);
    if (!news) return nlohmann::ordered_json();
    const auto& robots = (*news->state)["robots"];
    return robots.empty() ? nlohmann::ordered_json() : robots[0];
  };
  test::Await([&] { return robot_shown().is_object(); }, "the robot");

  const auto told = hasty_.Tell(NowOrder::kStop, {NowWhom::kAll, ""}, "rain");
  ASSERT_TRUE(told) << told.error().message;
  ASSERT_EQ(told->size(), 1U);
  EXPECT_FALSE(told->front().answered);
  EXPECT_THAT(told->front().detail, HasSubstr("moving at 0.40 m/s"));
  test::Await([&] { return robot_shown()["unanswered_stop_unix_ms"].is_number(); },
              "that it is not stopped");

  const auto before = Heard<exchange::NowCommand>();  // what it was told meanwhile
  const auto again = Heard<exchange::NowCommand>();
  EXPECT_EQ(again.number, before.number);
  EXPECT_EQ(again.order, NowOrder::kStop);
  EXPECT_EQ(again.name, "robot1");
  ASSERT_TRUE(robot_->Publish(exchange::NowAnswer{
      .agent = AgentId("robot1"), .client = again.client, .number = again.number}));
  test::Await([&] { return robot_shown()["unanswered_stop_unix_ms"].is_null(); },
              "that it is stopped");
}

TEST_F(DeskTest, ARobotThatNobodyHasHeardOfIsSentNowhere) {
  const auto server = bus_.Open(exchange::ServerTopics());
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  ASSERT_TRUE(robot_->Publish(status));
  test::Await(
      [&] {
        const auto news = desk_.See(0, test::kLongEnough);
        return news && !(*news->state)["robots"].empty();
      },
      "the robot");
  int sent = 0;
  bool has_heard_of_it = false;
  const auto send = [&](bool also_unheard) {
    auto report = std::async(std::launch::async, [&] {
      return desk_.Send({.agent = AgentId("robot7"), .id = "trip", .orders = "wait 1"},
                        also_unheard);
    });
    test::Await(
        [&] {
          for (const exchange::Message& message : server->Take(milliseconds(10))) {
            if (const auto* asked = std::get_if<exchange::MissionRequest>(&message)) {
              exchange::MissionReply reply{
                  .server = AgentId("barn"), .client = asked->client, .request = asked->request};
              if (has_heard_of_it && asked->query.agent == "robot7") {
                reply.missions.push_back(
                    {.mission = {.agent = AgentId("robot7"),
                                 .id = "earlier",
                                 .client = AgentId("other"),
                                 .orders = "wait 1"},
                     .last = {.agent = AgentId("robot7"), .mission = "earlier", .change = 1}});
              }
              EXPECT_TRUE(server->Publish(reply));
            } else if (const auto* mission = std::get_if<mission::Mission>(&message)) {
              ++sent;
              EXPECT_TRUE(server->Publish(mission::Report{.agent = mission->agent,
                                                          .mission = mission->id,
                                                          .state = mission::State::kRefused,
                                                          .relayed = true}));
            }
          }
          return report.wait_for(milliseconds(0)) == std::future_status::ready;
        },
        "an answer to the mission");
    return report.get();
  };
  const auto nobody = send(false);
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(nobody.error().message, HasSubstr("did you mean 'robot1'?"));
  EXPECT_EQ(sent, 0);
  EXPECT_TRUE(send(true)) << "whoever asks for that";
  has_heard_of_it = true;
  EXPECT_TRUE(send(false)) << "it is out of reach";
}

TEST_F(DeskTest, AMissionThatAServerPutsOffIsSentAgain) {
  const auto server = bus_.Open(exchange::ServerTopics());
  auto sent = std::async(std::launch::async, [&] {
    return desk_.Send({.agent = AgentId("robot1"), .id = "trip", .orders = "wait 1"}, true);
  });
  int times = 0;
  test::Await(
      [&] {
        for (const exchange::Message& message : server->Take(milliseconds(10))) {
          const auto* mission = std::get_if<mission::Mission>(&message);
          if (mission == nullptr) continue;
          const auto state = ++times < 3 ? mission::State::kPutOff : mission::State::kSent;
          EXPECT_TRUE(server->Publish(mission::Report{.agent = mission->agent,
                                                      .mission = mission->id,
                                                      .state = state,
                                                      .detail = "over quota",
                                                      .relayed = true}));
        }
        return sent.wait_for(milliseconds(0)) == std::future_status::ready;
      },
      "an answer to the mission");
  const auto reports = sent.get();
  ASSERT_TRUE(reports) << reports.error().message;
  ASSERT_EQ(reports->size(), 1U);
  EXPECT_EQ(reports->front().state, mission::State::kSent);
}

TEST_F(DeskTest, AStopGoesOutWhileAllElseThatMayBeAskedWaits) {
  std::vector<std::future<bool>> others;
  for (std::size_t i = 0; i < 2 * Desk::kMostErrands; ++i) {
    others.push_back(
        std::async(std::launch::async, [&] { return hasty_.Missions({}).has_value(); }));
  }
  auto stop = std::async(std::launch::async, [&] {
    return hasty_.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, "");
  });
  EXPECT_EQ(Heard<exchange::NowCommand>().order, NowOrder::kStop);
  ASSERT_TRUE(stop.get());
  for (auto& other : others) EXPECT_FALSE(other.get());
  const auto after = hasty_.Tell(NowOrder::kPause, {NowWhom::kRobot, "robot1"}, "");
  EXPECT_TRUE(after) << "there is room again";
}

TEST_F(DeskTest, NewsComeWhenSomethingHasChanged) {
  const auto first = desk_.See(0, milliseconds(20'000));
  ASSERT_TRUE(first);
  EXPECT_FALSE(desk_.See(first->number, milliseconds(300)));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  ASSERT_TRUE(robot_->Publish(status));
  const auto second = desk_.See(first->number, milliseconds(20'000));
  ASSERT_TRUE(second);
  EXPECT_EQ((*second->state)["robots"][0]["name"], "robot1");
}

TEST_F(DeskTest, WhoWaitsForNewsLooksHoweverLongThatTakes) {
  const auto first = hasty_.See(0, milliseconds(20'000));
  ASSERT_TRUE(first);
  auto news =
      std::async(std::launch::async, [&] { return hasty_.See(first->number, milliseconds(5000)); });
  (void)robot_->Take(milliseconds(300));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  ASSERT_TRUE(robot_->Publish(status));
  EXPECT_TRUE(news.get());
}

TEST_F(DeskTest, ServersAreAskedOnlyWhileSomebodyLooks) {
  const auto server = bus_.Open(exchange::ServerTopics());
  EXPECT_TRUE(server->Take(milliseconds(500)).empty());
  ASSERT_TRUE(desk_.See(0, milliseconds(20'000)));
  bool asked = false;
  test::Await(
      [&] {
        for (const exchange::Message& message : server->Take(milliseconds(100))) {
          asked |= std::holds_alternative<exchange::MissionRequest>(message);
          EXPECT_FALSE(std::holds_alternative<exchange::CatalogRequest>(message))
              << "no robot is on any";
        }
        return asked;
      },
      "a server to be asked");
}

TEST_F(DeskTest, WhoLooksAgainLaterSeesNothingOld) {
  const auto first = hasty_.See(0, milliseconds(20'000));
  ASSERT_TRUE(first);
  std::shared_ptr<const Desk::News> later;
  test::Await(
      [&] {
        (void)robot_->Take(milliseconds(300));  // meanwhile nobody looks
        later = hasty_.See(0, test::kLongEnough);
        return later && later->number != first->number;
      },
      "news that are new");
  ASSERT_TRUE(later);
  EXPECT_EQ(*later->state, *first->state);
}

TEST_F(DeskTest, AServerSaysWhatItHasAndWhyItChangesNothing) {
  const auto server = bus_.Open(exchange::ServerTopics());
  const auto answer = [&](const std::string& error) {
    const auto answers = [&](const exchange::Message& message) {
      exchange::CatalogReply reply;
      reply.server = AgentId("barn");
      reply.error = error;
      if (const auto* query = std::get_if<exchange::CatalogRequest>(&message)) {
        EXPECT_EQ(query->query.name_prefix, "ha");
        reply.client = query->client;
        reply.request = query->request;
        reply.page.total = 7;
      } else if (const auto* edit = std::get_if<exchange::RouteEditRequest>(&message)) {
        EXPECT_EQ(edit->edit.route, "hall");
        reply.client = edit->client;
        reply.request = edit->request;
      } else {
        return false;
      }
      EXPECT_TRUE(server->Publish(reply));
      return true;
    };
    test::Await(
        [&] {
          const auto heard = server->Take(milliseconds(100));
          return std::any_of(heard.begin(), heard.end(), answers);
        },
        "a question to the server");
  };
  auto routes = std::async(std::launch::async, [&] { return desk_.Routes({.name_prefix = "ha"}); });
  answer("");
  EXPECT_EQ(routes.get()->page.total, 7U);
  auto edited = std::async(std::launch::async, [&] {
    return desk_.Edit({.action = route::EditAction::kRollBack, .route = "hall"});
  });
  answer("there is none before it");
  const auto why = edited.get();
  ASSERT_FALSE(why);
  EXPECT_EQ(why.error().code, ErrorCode::kConflict);
  EXPECT_THAT(why.error().message, HasSubstr("'barn': there is none before it"));
}

TEST_F(DeskTest, ThoseWhoLookThroughOneCameraAtOnceShareThePictures) {
  constexpr int kLookers = 12;
  std::latch all(kLookers);
  std::vector<std::future<bool>> seen;
  for (int i = 0; i < kLookers; ++i) {
    seen.push_back(std::async(std::launch::async, [&] {
      all.arrive_and_wait();
      const auto snapshot = desk_.Look(AgentId("robot1"));
      return snapshot && *snapshot && (*snapshot)->picture.size() == 3;
    }));
  }
  int asked = 0;
  const auto all_have_seen = [&] {
    return std::all_of(seen.begin(), seen.end(), [](const std::future<bool>& one) {
      return one.wait_for(milliseconds(0)) == std::future_status::ready;
    });
  };
  test::Await(
      [&] {
        for (const exchange::Message& message : robot_->Take(milliseconds(10))) {
          const auto* request = std::get_if<exchange::SnapshotRequest>(&message);
          if (request == nullptr) continue;
          ++asked;
          EXPECT_TRUE(robot_->Publish(exchange::Snapshot{.agent = request->agent,
                                                         .client = request->client,
                                                         .request = request->request,
                                                         .picture = {1, 2, 3}}));
        }
        return all_have_seen();
      },
      "pictures for all");
  for (auto& one : seen) EXPECT_TRUE(one.get());
  EXPECT_LT(asked, kLookers);
}

TEST_F(DeskTest, ARobotThatShowsNothingIsWaitedForAndThenNot) {
  const auto snapshot = desk_.Look(AgentId("robot1"));
  ASSERT_TRUE(snapshot) << snapshot.error().message;
  EXPECT_EQ(*snapshot, nullptr);
}

TEST_F(DeskTest, ClosedItLetsGoWhoWaits) {
  auto news = std::async(std::launch::async, [&] {
    const auto first = desk_.See(0, milliseconds(60'000));
    return desk_.See(first ? first->number : 0, milliseconds(60'000)) == nullptr;
  });
  desk_.Close();
  EXPECT_TRUE(news.get());
  EXPECT_FALSE(desk_.Tell(NowOrder::kStop, {NowWhom::kRobot, "robot1"}, ""));
}

}  // namespace
}  // namespace trailcast::console
