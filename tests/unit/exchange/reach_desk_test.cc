#include "services/exchange/reach_desk.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::IsEmpty;
using testing::SizeIs;

constexpr ReachDesk::Time kNoon{std::chrono::hours(1)};
const AgentId kTheDesk("desk");
const AgentId kTheRobot("robot");
const AgentId kTheServer("server");

AgentStatus Says(const AgentId& agent, AgentRole role, std::uint64_t instance = 1) {
  return {.agent = agent, .instance = instance, .role = role};
}

ReachRequest Question(std::uint64_t number) { return {.client = kTheDesk, .request = number}; }

template <typename Kind>
std::vector<Kind> Of(const std::vector<Message>& messages) {
  std::vector<Kind> found;
  for (const Message& message : messages) {
    if (const auto* one = std::get_if<Kind>(&message)) found.push_back(*one);
  }
  return found;
}

TEST(ReachDesk, KnowsSinceWhenAndFromWhereEachIsHeard) {
  ReachDesk desk(kTheRobot, AgentRole::kFollower);
  AgentStatus server = Says(kTheServer, AgentRole::kServer);
  desk.Handle(server, kNoon);
  server.arrival = {.address = "10.0.0.2:7411", .network = "wlan0", .late = milliseconds(3)};
  desk.Handle(server, kNoon + seconds(2));
  desk.Handle(Says(kTheRobot, AgentRole::kFollower, 9), kNoon);  // a namesake
  const auto heard = desk.Heard(kNoon + seconds(3));
  ASSERT_THAT(heard, SizeIs(1));
  EXPECT_EQ(heard[0], (HeardAgent{.agent = kTheServer,
                                  .role = AgentRole::kServer,
                                  .heard_for = seconds(3),
                                  .age = seconds(1),
                                  .late_ms = 3.0,
                                  .address = "10.0.0.2:7411",
                                  .network = "wlan0"}));
}

TEST(ReachDesk, ForgetsWhoIsGoneAndStartsAnewWithAnotherProcess) {
  ReachDesk desk(kTheRobot, AgentRole::kFollower);
  desk.Handle(Says(kTheServer, AgentRole::kServer, 1), kNoon);
  desk.Handle(Says(kTheServer, AgentRole::kServer, 2), kNoon + seconds(5));
  desk.Handle(AgentGone{kTheServer, 1}, kNoon + seconds(6));
  ASSERT_THAT(desk.Heard(kNoon + seconds(6)), SizeIs(1));
  EXPECT_EQ(desk.Heard(kNoon + seconds(6))[0].heard_for, seconds(1));
  desk.Handle(AgentGone{kTheServer, 2}, kNoon + seconds(7));
  EXPECT_THAT(desk.Heard(kNoon + seconds(7)), IsEmpty());
}

TEST(ReachDesk, AnswersInPartsThatAreWithinBounds) {
  ReachDesk desk(kTheServer, AgentRole::kServer);
  for (std::size_t i = 0; i < kMaxHeardAgents + 1; ++i) {
    desk.Handle(Says(AgentId(fmt::format("robot{:04}", i)), AgentRole::kFollower), kNoon);
  }
  desk.Handle(Question(7), kNoon);
  const auto reports = Of<ReachReport>(desk.TakeOutgoing());
  ASSERT_THAT(reports, SizeIs(2));
  EXPECT_THAT(reports[0].heard, SizeIs(kMaxHeardAgents));
  ASSERT_THAT(reports[1].heard, SizeIs(1));
  EXPECT_EQ(reports[1].before, kMaxHeardAgents);
  EXPECT_EQ(reports[1].client, kTheDesk);
  EXPECT_EQ(reports[1].request, 7U);
  for (const ReachReport& report : reports) EXPECT_TRUE(CheckBounds(report));
}

TEST(ReachDesk, OfNobodyTellsThatToo) {
  ReachDesk desk(kTheRobot, AgentRole::kScout);
  desk.Handle(Question(1), kNoon);
  const auto reports = Of<ReachReport>(desk.TakeOutgoing());
  ASSERT_THAT(reports, SizeIs(1));
  EXPECT_EQ(reports[0].role, AgentRole::kScout);
  EXPECT_THAT(reports[0].heard, IsEmpty());
}

TEST(ReachDesk, OfAServerPassesQuestionsOnOnceAndNotAllOfAFlood) {
  ReachDesk desk(kTheServer, AgentRole::kServer);
  desk.Handle(Question(1), kNoon);
  const auto passed = Of<ReachRequest>(desk.TakeOutgoing());
  ASSERT_THAT(passed, SizeIs(1));
  EXPECT_TRUE(passed[0].relayed);
  EXPECT_EQ(passed[0].server, kTheServer);
  EXPECT_EQ(passed[0].client, kTheDesk);
  EXPECT_TRUE(CheckBounds(passed[0]));
  desk.Handle(Question(2), kNoon + ReachDesk::kPassesOnEvery / 2);
  EXPECT_THAT(Of<ReachRequest>(desk.TakeOutgoing()), IsEmpty());
  desk.Handle(Question(3), kNoon + ReachDesk::kPassesOnEvery);
  EXPECT_THAT(Of<ReachRequest>(desk.TakeOutgoing()), SizeIs(1));

  ReachDesk other(AgentId("other"), AgentRole::kServer);
  other.Handle(passed[0], kNoon);
  const auto said = other.TakeOutgoing();
  EXPECT_THAT(Of<ReachRequest>(said), IsEmpty());
  ASSERT_THAT(Of<ReachReport>(said), SizeIs(1));
  EXPECT_EQ(Of<ReachReport>(said)[0].server, kTheServer);
}

TEST(ReachDesk, OfARobotPassesNothingOnAndAnOperatorsDoesNotAnswer) {
  ReachDesk robot(kTheRobot, AgentRole::kFollower);
  robot.Handle(Question(1), kNoon);
  EXPECT_THAT(Of<ReachRequest>(robot.TakeOutgoing()), IsEmpty());
  ReachDesk desk(AgentId("other-desk"), AgentRole::kOperator);
  desk.Handle(Question(1), kNoon);
  EXPECT_THAT(desk.TakeOutgoing(), IsEmpty());
}

// A server between a desk and a robot that do not hear each other.
class RelayTest : public testing::Test {
 protected:
  RelayTest() {
    server_.Handle(Says(kTheRobot, AgentRole::kFollower), kNoon);
    robot_.Handle(Says(kTheServer, AgentRole::kServer), kNoon);
  }
  // The robot answers after so long; what the server then passes on.
  std::vector<ReachReport> Ask(const ReachRequest& question, milliseconds after) {
    asked_at_ += seconds(1);
    server_.Handle(question, asked_at_);
    for (const ReachRequest& passed : Of<ReachRequest>(server_.TakeOutgoing())) {
      robot_.Handle(passed, asked_at_);
    }
    for (const ReachReport& answer : Of<ReachReport>(robot_.TakeOutgoing())) {
      server_.Handle(answer, asked_at_ + after);
    }
    return Of<ReachReport>(server_.TakeOutgoing());
  }
  std::optional<double> RoundTrip_ms() { return server_.Heard(asked_at_)[0].round_trip_ms; }

  ReachDesk::Time asked_at_ = kNoon;
  ReachDesk server_{kTheServer, AgentRole::kServer};
  ReachDesk robot_{kTheRobot, AgentRole::kFollower};
};

TEST_F(RelayTest, PassesAnswersOnOnce) {
  const auto passed = Ask(Question(1), milliseconds(5));
  ASSERT_THAT(passed, SizeIs(1));
  EXPECT_TRUE(passed[0].relayed);
  EXPECT_EQ(passed[0].agent, kTheRobot);
  EXPECT_EQ(passed[0].client, kTheDesk);
  ASSERT_THAT(passed[0].heard, SizeIs(1));
  EXPECT_EQ(passed[0].heard[0].agent, kTheServer);
  server_.Handle(passed[0], kNoon);
  EXPECT_THAT(server_.TakeOutgoing(), IsEmpty());
}

TEST_F(RelayTest, MeasuresTheShortestWayThereAndBackForEachWhoAsks) {
  EXPECT_EQ(RoundTrip_ms(), std::nullopt);
  (void)Ask(Question(1), milliseconds(7));
  (void)Ask(Question(2), milliseconds(4));
  (void)Ask(Question(3), milliseconds(9));
  EXPECT_EQ(RoundTrip_ms(), 4.0);
  (void)Ask({.client = AgentId("other-desk"), .request = 1}, milliseconds(20));
  EXPECT_EQ(RoundTrip_ms(), 20.0);
}

TEST_F(RelayTest, MeasuresByWhatItAskedItself) {
  (void)Ask(Question(1), milliseconds(7));
  ReachReport answer{
      .agent = kTheRobot, .client = kTheDesk, .request = 1, .server = AgentId("other")};
  server_.Handle(answer, asked_at_ + milliseconds(1));
  answer.server = AgentId("");
  server_.Handle(answer, asked_at_ + milliseconds(1));
  EXPECT_EQ(RoundTrip_ms(), 7.0);
  EXPECT_THAT(server_.TakeOutgoing(), IsEmpty());
}

TEST(ReachDesk, RemembersNamesThatAreMadeUpUpToABound) {
  ReachDesk desk(kTheServer, AgentRole::kServer);
  for (std::size_t i = 0; i < ReachDesk::kMostAgents + 10; ++i) {
    desk.Handle(Says(AgentId(fmt::format("r{}", i)), AgentRole::kFollower), kNoon);
  }
  EXPECT_THAT(desk.Heard(kNoon), SizeIs(ReachDesk::kMostAgents));
}

}  // namespace
}  // namespace trailcast::exchange
