#include "services/program/presence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "services/exchange/bounds.h"
#include "services/exchange/in_process_exchange.h"

namespace trailcast::program {
namespace {

using exchange::AgentMode;
using exchange::AgentStatus;
using testing::HasSubstr;

AgentStatus Status(const std::string& name, std::uint64_t instance, AgentMode mode) {
  AgentStatus status;
  status.agent = AgentId(name);
  status.instance = instance;
  status.mode = mode;
  return status;
}

TEST(NameClaimTest, YieldsToWhoeverHasTheName) {
  const NameClaim claim(Status("scout", 5, AgentMode::kStarting));
  const auto seen = claim.See(Status("scout", 9, AgentMode::kTeaching));
  ASSERT_FALSE(seen);
  EXPECT_EQ(seen.error().code, ErrorCode::kConflict);
  EXPECT_THAT(seen.error().message, HasSubstr("agent name 'scout' is already used"));
  EXPECT_THAT(seen.error().message, HasSubstr("0000000000000009"));
}

TEST(NameClaimTest, IsNotDisturbedByOthersItselfOrTheEnded) {
  const NameClaim claim(Status("scout", 5, AgentMode::kStarting));
  EXPECT_TRUE(claim.See(Status("scout2", 9, AgentMode::kTeaching)));
  EXPECT_TRUE(claim.See(Status("scout", 5, AgentMode::kTeaching)));
  EXPECT_TRUE(claim.See(Status("scout", 9, AgentMode::kStopped)));
}

TEST(NameClaimTest, LetsOneOfTwoThatStartTogetherHaveTheName) {
  const NameClaim small(Status("scout", 5, AgentMode::kStarting));
  const NameClaim large(Status("scout", 9, AgentMode::kStarting));
  EXPECT_TRUE(small.See(Status("scout", 9, AgentMode::kStarting)));
  EXPECT_FALSE(large.See(Status("scout", 5, AgentMode::kStarting)));
}

class PresenceTest : public testing::Test {
 protected:
  std::unique_ptr<exchange::RouteExchange> Open() {
    return bus_.Open(WithAgents(exchange::ScoutTopics()));
  }
  // `meanwhile` is called again and again while it listens.
  static Result<void> Claim(
      Presence& presence, const std::function<void()>& meanwhile = [] {}) {
    return presence.Claim([](const exchange::Message&) {},
                          [&] {
                            meanwhile();
                            return false;
                          });
  }
  exchange::InProcessBus bus_;
};

TEST_F(PresenceTest, RefusesANameThatARunningAgentHas) {
  const auto first_end = Open();
  Presence first(*first_end, Status("scout", 0, AgentMode::kStarting));
  ASSERT_TRUE(Claim(first));
  first.Set(Status("", 0, AgentMode::kTeaching));
  first.Publish();
  // It did not hear that: the running one tells it.
  const auto second_end = Open();
  Presence second(*second_end, Status("scout", 0, AgentMode::kStarting));
  EXPECT_FALSE(Claim(second, [&] {
    for (const auto& message : first_end->Take(std::chrono::milliseconds(0))) {
      first.Handle(message);
    }
  }));
}

TEST_F(PresenceTest, LetsExactlyOneOfTwoStartTogether) {
  const auto first_end = Open();
  const auto second_end = Open();
  Presence first(*first_end, Status("scout", 0, AgentMode::kStarting));
  Presence second(*second_end, Status("scout", 0, AgentMode::kStarting));
  // Together: each has said its name before the other is done with listening.
  std::latch both_listen(2);
  const auto claim = [&](Presence& presence) {
    return Claim(presence, [&, arrived = false]() mutable {
      if (!std::exchange(arrived, true)) both_listen.arrive_and_wait();
    });
  };
  Result<void> first_result;
  std::thread other([&] { first_result = claim(first); });
  const auto second_result = claim(second);
  other.join();
  EXPECT_NE(first_result.has_value(), second_result.has_value());
}

TEST_F(PresenceTest, KnowsTheServerUntilItIsGone) {
  const auto end = Open();
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting));
  auto server = Status("server", 3, AgentMode::kWaiting);
  presence.Handle(server);
  EXPECT_FALSE(presence.server()) << "an operator is no server";
  server.role = exchange::AgentRole::kServer;
  presence.Handle(server);
  EXPECT_EQ(presence.server(), AgentId("server"));
  presence.Handle(exchange::AgentGone{AgentId("server"), 3});
  EXPECT_FALSE(presence.server());
}

TEST_F(PresenceTest, TellsWhatItFeelsWithEachStatusAndALowBatteryInWords) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("robot1", 7, AgentMode::kStarting));
  const auto said = [&] {
    presence.Publish();
    exchange::AgentStatus last;
    for (const exchange::Message& message : peer->Take(std::chrono::milliseconds(0))) {
      if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) last = *status;
    }
    return last;
  };
  EXPECT_EQ(said().battery_percent, std::nullopt) << "it tells none";
  Vitals vitals{.battery_percent = 20, .link_percent = 71};
  presence.FeelBy([&] { return vitals; });
  exchange::AgentStatus status = Status("robot1", 7, AgentMode::kWaiting);
  status.detail = "free";
  presence.Set(status);
  EXPECT_EQ(said().battery_percent, 20);
  EXPECT_EQ(said().link_percent, 71);
  EXPECT_EQ(said().detail, "free");
  vitals = {.battery_percent = 19};
  EXPECT_EQ(said().detail, "free; battery low: 19 %");
  EXPECT_EQ(said().link_percent, std::nullopt);
  presence.Set(Status("robot1", 7, AgentMode::kWaiting));
  EXPECT_EQ(said().detail, "battery low: 19 %");
  const std::string why(400, 'y');
  status.detail = why;
  presence.Set(status);
  EXPECT_EQ(said().detail, why + "; battery low: 19 %") << "a reason is not cut off";
  status.detail = std::string(2 * exchange::kMaxLineBytes, 'y');
  presence.Set(status);
  EXPECT_LE(said().detail.size(), exchange::kMaxLineBytes);
  EXPECT_THAT(said().detail, testing::EndsWith("; battery low: 19 %"));
}

TEST_F(PresenceTest, OfSeveralServersItKnowsOneThatIsThere) {
  const auto end = Open();
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting));
  const auto say = [&](const std::string& name, std::uint64_t instance, AgentMode mode) {
    auto server = Status(name, instance, mode);
    server.role = exchange::AgentRole::kServer;
    presence.Handle(server);
  };
  say("first", 1, AgentMode::kWaiting);
  say("second", 2, AgentMode::kWaiting);
  EXPECT_EQ(presence.server(), AgentId("first")) << "it is still there";
  EXPECT_EQ(presence.servers(), (std::set{AgentId("first"), AgentId("second")}));
  presence.Handle(exchange::AgentGone{AgentId("second"), 2});
  EXPECT_EQ(presence.server(), AgentId("first")) << "though the other was heard last";
  say("second", 3, AgentMode::kWaiting);
  say("first", 1, AgentMode::kStopped);
  EXPECT_EQ(presence.server(), AgentId("second"));
  say("second", 4, AgentMode::kWaiting);
  presence.Handle(exchange::AgentGone{AgentId("second"), 3});
  EXPECT_EQ(presence.server(), AgentId("second")) << "it was started anew";
  presence.Handle(exchange::AgentGone{AgentId("second"), 4});
  EXPECT_FALSE(presence.server());
}

TEST_F(PresenceTest, MadeUpNamesFillNeitherMemoryNorTime) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting));
  for (std::size_t i = 0; i < 3 * Presence::kMostAgents; ++i) {
    auto server = Status(fmt::format("server-{}", i), i, AgentMode::kWaiting);
    server.role = exchange::AgentRole::kServer;
    presence.Handle(server);
  }
  EXPECT_EQ(presence.servers().size(), exchange::ServersThere::kMost);
  presence.Publish();
  (void)peer->Take(std::chrono::milliseconds(0));
  const auto longest = Presence::kForEachAgent * static_cast<int>(Presence::kMostAgents);
  presence.Tick(Presence::Clock::now() + longest);
  EXPECT_EQ(peer->Take(std::chrono::milliseconds(0)).size(), 1U);
}

TEST_F(PresenceTest, PublishesAChangeOfModeAtOnceAndTheRestAtIntervals) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting), std::chrono::hours(1));
  const auto now = Presence::Clock::now();
  presence.Publish();
  auto status = presence.status();
  status.features = 7;
  presence.Set(status);
  presence.Tick(now);
  EXPECT_EQ(peer->Take(std::chrono::milliseconds(0)).size(), 1U);
  status.mode = AgentMode::kTeaching;
  presence.Set(status);
  presence.Tick(now);
  const auto heard = peer->Take(std::chrono::milliseconds(0));
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(std::get<AgentStatus>(heard.front()).features, 7U);
  presence.Tick(now + std::chrono::hours(2));
  EXPECT_EQ(peer->Take(std::chrono::milliseconds(0)).size(), 1U);
}

TEST_F(PresenceTest, PublishesLessOftenTheMoreAgentsThereAre) {
  constexpr int kAgents = 100;
  constexpr auto kSlower = kAgents * Presence::kForEachAgent;
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting), std::chrono::milliseconds(200));
  const auto publishes_after = [&](std::chrono::milliseconds passed) {
    presence.Publish();
    const auto published = Presence::Clock::now();
    (void)peer->Take(std::chrono::milliseconds(0));
    presence.Tick(published + passed);
    return !peer->Take(std::chrono::milliseconds(0)).empty();
  };
  EXPECT_TRUE(publishes_after(std::chrono::milliseconds(200)));
  for (int i = 0; i < kAgents; ++i) {
    presence.Handle(Status(fmt::format("agent-{}", i), 3, AgentMode::kWaiting));
  }
  EXPECT_FALSE(publishes_after(kSlower / 2));
  EXPECT_TRUE(publishes_after(kSlower));
  for (int i = 0; i < kAgents; ++i) {
    presence.Handle(exchange::AgentGone{AgentId(fmt::format("agent-{}", i)), 3});
  }
  EXPECT_TRUE(publishes_after(std::chrono::milliseconds(200)));
}

exchange::Fleet Told(std::vector<exchange::ClaimedName> claimed) {
  return {.server = AgentId("server"), .agents = 2, .claimed = std::move(claimed)};
}

TEST(NameClaimTest, BelievesAServerWhoseNameItIs) {
  const NameClaim claim(Status("scout", 5, AgentMode::kStarting));
  EXPECT_TRUE(claim.See({AgentId("scout"), 5, 0}));
  EXPECT_TRUE(claim.See({AgentId("scout"), 9, 5}));
  EXPECT_TRUE(claim.See({AgentId("scout2"), 5, 9}));
  EXPECT_FALSE(claim.See({AgentId("scout"), 5, 9}));
  EXPECT_FALSE(claim.See({AgentId("scout"), 5, 3}));
}

TEST_F(PresenceTest, SpeaksUpWhenAServerTellsThatItsNameIsClaimed) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting), std::chrono::hours(1));
  presence.Publish();
  (void)peer->Take(std::chrono::milliseconds(0));
  presence.Handle(Told({{AgentId("other"), 9, 0}}));
  presence.Handle(Told({{AgentId("scout"), presence.status().instance, 0}}));
  EXPECT_TRUE(peer->Take(std::chrono::milliseconds(0)).empty());
  presence.Handle(Told({{AgentId("scout"), 9, 0}}));
  EXPECT_EQ(peer->Take(std::chrono::milliseconds(0)).size(), 1U);
}

TEST_F(PresenceTest, TellsOfAnotherOfItsNameAsLongAsThereIsOne) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting));
  const auto detail = [&] {
    presence.Publish();
    const auto heard = peer->Take(std::chrono::milliseconds(0));
    return heard.empty() ? "" : std::get<AgentStatus>(heard.back()).detail;
  };
  presence.Handle(Status("scout", 9, AgentMode::kStarting));
  EXPECT_EQ(detail(), "") << "it claims the name, and is refused";
  presence.Handle(Status("scout", 9, AgentMode::kTeaching));
  EXPECT_THAT(detail(), HasSubstr("another running process is called 'scout'"));
  presence.Handle(exchange::AgentGone{AgentId("scout"), 9});
  EXPECT_EQ(detail(), "");
  // Where it does not hear the other, a server tells it.
  const std::uint64_t own = presence.status().instance;
  presence.Handle(Told({{AgentId("scout"), own, 9}}));
  EXPECT_THAT(detail(), HasSubstr("0000000000000009"));
  presence.Handle(Told({}));
  EXPECT_EQ(detail(), "");
  presence.Handle(Told({{AgentId("scout"), 9, own}}));
  EXPECT_THAT(detail(), HasSubstr("0000000000000009"));
  presence.Handle(exchange::AgentGone{AgentId("server"), 7});
  EXPECT_EQ(detail(), "");
}

TEST_F(PresenceTest, PublishesLessOftenTheMoreAgentsAServerTellsOf) {
  const auto end = Open();
  const auto peer = bus_.Open(exchange::OperatorTopics());
  Presence presence(*end, Status("scout", 0, AgentMode::kStarting));
  presence.Handle(exchange::Fleet{.server = AgentId("server"), .agents = 1000, .claimed = {}});
  presence.Publish();
  const auto published = Presence::Clock::now();
  (void)peer->Take(std::chrono::milliseconds(0));
  presence.Tick(published + std::chrono::seconds(9));
  EXPECT_TRUE(peer->Take(std::chrono::milliseconds(0)).empty());
  presence.Tick(published + std::chrono::seconds(11));
  EXPECT_EQ(peer->Take(std::chrono::milliseconds(0)).size(), 1U);
}

}  // namespace
}  // namespace trailcast::program
