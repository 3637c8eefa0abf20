// A server that is killed again and again while twenty scouts teach.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <random>
#include <thread>

#include "services/store/route_store.h"
#include "tests/scenario/sharing/kill_scout.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {
namespace {

constexpr std::uint32_t kScouts = 20;

// All rounds: TRAILCAST_KILL_ROUNDS=100.
int Rounds() {
  const char* wanted = std::getenv("TRAILCAST_KILL_ROUNDS");  // NOLINT(concurrency-mt-unsafe)
  return wanted == nullptr ? 5 : std::atoi(wanted);
}

class ServerKill : public KillScoutsTest {
 protected:
  void SetUp() override { StartScouts(kScouts, tag_); }
  void StartServer() {
    server_ = std::make_unique<Process>(
        std::vector<std::string>{ProgramsDir() + "/trailcast-server", "--dds-tag", tag_,
                                 "--network-interface", "lo", "--store", file_.string()},
        (folder_ / "server.log").string());
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  // Nobody has the store open.
  void ExpectReceiptedIsHeld() {
    KillScoutsTest::ExpectReceiptedIsHeld(store::OpenSqliteStore(file_));
  }

  TempDir folder_;
  const std::filesystem::path file_ = folder_ / "server.db";
  const std::string tag_ = fmt::format("kill-{}", getpid());
  std::unique_ptr<Process> server_;
};

TEST_F(ServerKill, LosesNothingThatItReceiptedAndCompletesEveryRoute) {
  std::mt19937 random(20090401);
  for (int round = 0; round < Rounds(); ++round) {
    StartServer();
    const std::size_t enough = Receipts() + random() % 200;
    ASSERT_TRUE(Await([&] { return Receipts() > enough; })) << server_->output();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));  // any moment
    server_->Signal(SIGKILL);
    (void)server_->Wait();
    ExpectReceiptedIsHeld();
    if (HasFatalFailure()) return;
  }
  StartServer();
  for (const auto& scout : scouts_) scout->Finish();
  for (const auto& scout : scouts_) {
    ASSERT_TRUE(Await([&] { return scout->delivered(); })) << server_->output();
  }
  server_->Signal(SIGTERM);
  EXPECT_EQ(server_->Wait(), 0);
  ExpectReceiptedIsHeld();
  auto store = store::OpenSqliteStore(file_).value();
  std::size_t taught = 0;
  for (std::uint32_t i = 0; i < kScouts; ++i) {
    const auto info = store->FindRoute(KeyNumber(i)).value();
    ASSERT_TRUE(info);
    EXPECT_EQ(info->state, route::RouteState::kComplete);
    EXPECT_EQ(info->segment_count, scouts_[i]->taught());
    EXPECT_EQ(store->HeldSegments(KeyNumber(i)).value().size(), scouts_[i]->taught());
    taught += scouts_[i]->taught();
  }
  EXPECT_TRUE(store->Verify().value().empty());
  EXPECT_EQ(checked_, taught);
  fmt::print("{} kills, {} segments of {} routes, all there\n", Rounds(), taught, kScouts);
}

}  // namespace
}  // namespace trailcast::test
