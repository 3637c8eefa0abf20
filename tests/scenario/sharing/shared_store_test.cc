// Two servers on one PostgreSQL, either of which, and PostgreSQL itself, may be killed at any
// moment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <cstdlib>
#include <random>

#include "services/exchange/route_fetcher.h"
#include "services/store/route_store.h"
#include "tests/scenario/sharing/kill_scout.h"
#include "tests/support/places.h"
#include "tests/support/postgres_server.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::uint32_t kScouts = 8;

// All rounds: TRAILCAST_KILL_ROUNDS=100.
int Rounds() {
  const char* wanted = std::getenv("TRAILCAST_KILL_ROUNDS");  // NOLINT(concurrency-mt-unsafe)
  return wanted == nullptr ? 6 : std::atoi(wanted);
}

// Fetches a scout's route while it is being taught, on a thread of its own.
class KillFollower {
 public:
  KillFollower(std::uint32_t route, const std::string& tag)
      : route_(route), tag_(tag), thread_([this] { Run(); }) {}
  ~KillFollower() { give_up_ = true; }
  KillFollower(const KillFollower&) = delete;
  KillFollower& operator=(const KillFollower&) = delete;

  [[nodiscard]] std::uint32_t held() const { return held_; }
  [[nodiscard]] bool complete() const { return complete_; }

 private:
  void Run() {
    dds::DdsOptions options;
    options.discovery_tag = tag_;
    options.network_interface = "lo";
    options.self = AgentId(fmt::format("follower-{}", route_));
    const auto exchange = dds::OpenDdsExchange(options, exchange::FollowerTopics());
    if (!exchange || !(*exchange)->Listen(exchange::Topic::kSegments, {KeyNumber(route_)})) return;
    exchange::RouteFetcher fetcher(options.self, KeyNumber(route_), {},
                                   {route::CheckDigest, route::ManifestDigest}, Clock::now());
    while (!give_up_ && !complete_) {
      for (const exchange::Message& message : (*exchange)->Take(milliseconds(10))) {
        fetcher.Handle(message, Clock::now());
      }
      // A request that cannot be sent is repeated.
      (void)exchange::PublishAll(**exchange, fetcher.Tick(Clock::now()));
      (void)fetcher.TakeArrived();
      held_ = fetcher.Progress(Clock::now()).held;
      complete_ = fetcher.Complete();
    }
  }

  std::uint32_t route_;
  std::string tag_;
  std::atomic<bool> give_up_{false};
  std::atomic<bool> complete_{false};
  std::atomic<std::uint32_t> held_{0};
  std::jthread thread_;
};

class SharedStore : public KillScoutsTest {
 protected:
  void StartServer(std::size_t which) {
    servers_[which] = std::make_unique<Process>(
        Words("trailcast-server", {"--name", Name(which), "--store", url_}),
        folder_ / (Name(which) + ".log"));
    ASSERT_TRUE(servers_[which]->WaitForOutput("ready")) << servers_[which]->output();
  }
  void StartServers() {
    for (std::size_t which = 0; which < servers_.size(); ++which) StartServer(which);
  }
  void StartScouts() { KillScoutsTest::StartScouts(kScouts, tag_); }
  static std::string Name(std::size_t which) { return fmt::format("server-{}", which); }
  [[nodiscard]] std::vector<std::string> Words(const std::string& program,
                                               const std::vector<std::string>& more) const {
    std::vector<std::string> words{ProgramsDir() + "/" + program, "--dds-tag", tag_,
                                   "--network-interface", "lo"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  bool AwaitReceipts(std::size_t more) {
    const std::size_t enough = Receipts() + more;
    return Await([&] { return Receipts() > enough; });
  }
  std::string Logs() const {
    std::string logs;
    for (const auto& server : servers_) logs += server->output();
    return logs;
  }
  void ExpectReceiptedIsHeld() {
    KillScoutsTest::ExpectReceiptedIsHeld(store::OpenPostgresStore(url_, {.read_only = true}));
  }
  // Scouts end; every route is complete, and whole, with whoever has it.
  void ExpectAllEndsWell() {
    for (const auto& scout : scouts_) scout->Finish();
    for (const auto& scout : scouts_) {
      ASSERT_TRUE(Await([&] { return scout->delivered(); })) << Logs();
    }
    ExpectReceiptedIsHeld();
    auto store = store::OpenPostgresStore(url_, {.read_only = true}).value();
    std::size_t taught = 0;
    for (std::uint32_t i = 0; i < kScouts; ++i) {
      const auto info = store->FindRoute(KeyNumber(i)).value();
      ASSERT_TRUE(info);
      EXPECT_EQ(info->state, route::RouteState::kComplete);
      EXPECT_EQ(info->standing, route::Standing::kActive);
      EXPECT_EQ(info->segment_count, scouts_[i]->taught());
      taught += scouts_[i]->taught();
    }
    EXPECT_TRUE(store->Verify().value().empty());
    EXPECT_EQ(checked_, taught);
    for (const auto& server : servers_) {
      server->Signal(SIGTERM);
      EXPECT_EQ(server->Wait(), 0) << server->output();
    }
    EXPECT_THAT(Logs(), Not(HasSubstr(PostgresServer::kPassword)));
    fmt::print("{} segments of {} routes, all there\n", taught, kScouts);
  }

  TempDir folder_;
  PostgresServer postgres_{PostgresServer::Sync::kOn};
  const std::string url_ = postgres_.CreateDatabase();
  const std::string tag_ = fmt::format("shared-{}", getpid());
  std::array<std::unique_ptr<Process>, 2> servers_;
};

TEST_F(SharedStore, EitherServerKilledLosesNothingAndTheOtherGoesOn) {
  std::mt19937 random(20090401);
  StartScouts();
  StartServers();
  const KillFollower follower(0, tag_);
  for (int round = 0; round < Rounds(); ++round) {
    ASSERT_TRUE(AwaitReceipts(random() % 50)) << Logs();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));  // any moment
    const std::size_t victim = random() % servers_.size();
    servers_[victim]->Signal(SIGKILL);
    (void)servers_[victim]->Wait();
    ExpectReceiptedIsHeld();
    if (HasFatalFailure()) return;
    const std::uint32_t fetched = follower.held();
    ASSERT_TRUE(AwaitReceipts(10)) << "from the other one: " << Logs();
    ASSERT_TRUE(Await([&] { return follower.held() > fetched; })) << Logs();
    StartServer(victim);
    if (HasFatalFailure()) return;
  }
  ExpectAllEndsWell();
  EXPECT_TRUE(Await([&] { return follower.complete(); })) << follower.held();
}

TEST_F(SharedStore, PostgresKilledIsToldWaitedForAndLosesNothing) {
  StartScouts();
  StartServers();
  const KillFollower follower(0, tag_);
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(AwaitReceipts(20)) << Logs();
    postgres_.Stop(SIGKILL);
    for (const auto& server : servers_) {
      ASSERT_TRUE(server->WaitForOutput("is PostgreSQL running there")) << server->output();
    }
    Process asked(Words("trailcast", {"routes"}), folder_ / "asked.log");
    EXPECT_EQ(asked.Wait(), 1);
    EXPECT_THAT(asked.output(), HasSubstr("is PostgreSQL running there"));
    postgres_.Start();
    ASSERT_TRUE(AwaitReceipts(20)) << Logs();
    ExpectReceiptedIsHeld();
    if (HasFatalFailure()) return;
  }
  ExpectAllEndsWell();
  EXPECT_TRUE(Await([&] { return follower.complete(); })) << follower.held();
}

TEST_F(SharedStore, AServerThatNobodyAsksAnythingTellsThatPostgresIsAway) {
  const std::string beat = (folder_ / "beat").string();
  Process server(Words("trailcast-server", {"--store", url_, "--heartbeat", beat}),
                 folder_ / "idle.log");
  const auto health = [&] {
    Process asked({ProgramsDir() + "/trailcast-server", "health", "--heartbeat", beat},
                  folder_ / "health.log");
    const auto status = asked.Wait();
    return std::pair(status, asked.output());
  };
  ASSERT_TRUE(server.WaitForOutput("ready")) << server.output();
  ASSERT_TRUE(Await([&] { return health().first == 0; })) << health().second;
  postgres_.Stop(SIGKILL);
  ASSERT_TRUE(server.WaitForOutput("the store is away")) << server.output();
  ASSERT_TRUE(Await([&] { return health().first == 1; })) << health().second;
  EXPECT_THAT(health().second, HasSubstr("is PostgreSQL running there"));
  postgres_.Start();
  ASSERT_TRUE(server.WaitForOutput("the store is there again")) << server.output();
  EXPECT_TRUE(Await([&] { return health().first == 0; })) << health().second;
  EXPECT_THAT(server.output(), Not(HasSubstr(PostgresServer::kPassword)));
}

TEST_F(SharedStore, AnEditThatBothHearIsCarriedOutOnce) {
  constexpr std::uint32_t kRevisions = 3;
  auto store = store::OpenPostgresStore(url_).value();
  for (std::uint32_t revision = 1; revision <= kRevisions; ++revision) {
    auto piece = TaughtPiece(1, 0);
    piece.key.teaching = TeachingId(revision);
    auto info = InfoOf(piece.key, {&piece, 1}, route::RouteState::kComplete);
    info.manifest_digest = route::ManifestDigest({&piece.digest, 1});
    ASSERT_TRUE(store->AppendSegments({&piece, 1}));
    ASSERT_TRUE(store->PutRoute(info));
  }
  StartServers();
  const auto edit = [&](const std::vector<std::string>& words) {
    Process tool(Words("trailcast", words), folder_ / "edit.log");
    EXPECT_EQ(tool.Wait(), 0) << tool.output();
  };
  constexpr int kTimes = 5;
  for (int time = 0; time < kTimes; ++time) {
    edit({"routes", "activate", "corridor", "--revision", "3"});
    edit({"routes", "rollback", "corridor"});
    const auto active = store->QueryRoutes({.standing = route::Standing::kActive}).value();
    ASSERT_EQ(active.total, 1U);
    EXPECT_EQ(active.routes.front().key.teaching.value(), 2U);
  }
  const auto told = [&] {
    const std::string logs = Logs();
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = logs.find("' changes ", at)) != std::string::npos; ++at) ++lines;
    return lines;
  };
  // A server tells it once it has answered.
  EXPECT_TRUE(Await([&] { return told() >= 2U * kTimes; })) << Logs();
  EXPECT_EQ(told(), 2U * kTimes) << Logs();
}

TEST_F(SharedStore, CheckReadsItWhileServersUseItAndRepairsNothing) {
  const auto check = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"check", "--store", url_};
    words.insert(words.end(), more.begin(), more.end());
    Process checked(Words("trailcast-server", words), folder_ / "check.log");
    const auto status = checked.Wait();
    return std::pair(status.value_or(-1), checked.output());
  };
  EXPECT_THAT(check({}).second, HasSubstr("there is none in this database"));
  StartServers();
  auto store = store::OpenPostgresStore(url_).value();
  ASSERT_TRUE(store->AppendSegments(std::array{TaughtPiece(1, 0), TaughtPiece(1, 1)}));
  const auto whole = check({});
  EXPECT_EQ(whole.first, 0);
  EXPECT_THAT(whole.second, HasSubstr("is whole"));
  PostgresServer::Execute(url_, "UPDATE trailcast.segment SET number = 7 WHERE number = 1");
  const auto damaged = check({});
  EXPECT_EQ(damaged.first, 1);
  EXPECT_THAT(damaged.second, HasSubstr("damaged: "));
  const auto repair = check({"--repair"});
  EXPECT_NE(repair.first, 0);
  EXPECT_THAT(repair.second, HasSubstr("is not repaired from here"));
  EXPECT_EQ(store->HeldSegments(KeyNumber(1)).value().size(), 2U);
}

}  // namespace
}  // namespace trailcast::test
