// Two servers with a store each, as at two sites: killed, cut off from each other, begun apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <array>
#include <random>

#include "services/exchange/mirror.h"
#include "services/store/route_store.h"
#include "tests/scenario/sharing/kill_scout.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

class MirrorServers : public KillScoutsTest {
 protected:
  static std::string Name(std::size_t which) { return which == 0 ? "site-a" : "site-b"; }
  std::filesystem::path File(std::size_t which) { return folder_ / (Name(which) + ".db"); }
  void StartServer(std::size_t which) {
    servers_[which] = std::make_unique<Process>(
        std::vector<std::string>{ProgramsDir() + "/trailcast-server", "--name", Name(which),
                                 "--dds-tag", tag_, "--network-interface", "lo", "--store",
                                 File(which).string()},
        folder_ / (Name(which) + ".log"));
    ASSERT_TRUE(servers_[which]->WaitForOutput("ready")) << servers_[which]->output();
  }
  void Kill(std::size_t which) {
    servers_[which]->Signal(SIGKILL);
    (void)servers_[which]->Wait();
  }
  void AwaitWord(std::size_t which, const std::string& word) {
    ASSERT_TRUE(servers_[which]->WaitForOutput(word)) << Logs();
  }
  void AwaitInStep() {
    for (std::size_t which = 0; which < 2; ++which) {
      AwaitWord(which, "'" + Name(1 - which) + "' holds the same routes");
    }
  }
  std::string Logs() const {
    std::string logs;
    for (const auto& server : servers_) logs += server->output();
    return logs;
  }
  // How often it has said so.
  std::size_t Count(std::size_t which, const std::string& word) const {
    const std::string log = servers_[which]->output();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = log.find(word, at)) != std::string::npos; ++at) ++count;
    return count;
  }
  // Ends both servers, and returns what the sites hold then.
  std::array<std::unique_ptr<store::RouteStore>, 2> EndBoth() {
    std::array<std::unique_ptr<store::RouteStore>, 2> stores;
    for (std::size_t which = 0; which < 2; ++which) {
      servers_[which]->Signal(SIGTERM);
      EXPECT_EQ(servers_[which]->Wait(), 0) << servers_[which]->output();
      stores[which] = store::OpenSqliteStore(File(which)).value();
      EXPECT_TRUE(stores[which]->Verify().value().empty());
    }
    return stores;
  }
  // A stored route of one segment.
  static route::RouteInfo Put(store::RouteStore& store, std::uint32_t number) {
    route::SegmentPiece piece = TaughtPiece(number, 0);
    piece.key.route = RouteId(fmt::format("{:08x}{:024x}", number * 0x9E3779B1U, number));
    auto info = InfoOf(piece.key, {&piece, 1}, route::RouteState::kComplete);
    info.name = fmt::format("route-{}", number);
    info.manifest_digest = route::ManifestDigest({&piece.digest, 1});
    EXPECT_TRUE(store.AppendSegments({&piece, 1}));
    EXPECT_TRUE(store.PutRoute(info));
    return info;
  }

  TempDir folder_;
  const std::string tag_ = fmt::format("mirror-{}", getpid());
  std::array<std::unique_ptr<Process>, 2> servers_;
};

TEST_F(MirrorServers, ThatBeginApartComeToHoldTheSame) {
  constexpr std::uint32_t kRoutes = 300;  // more than are announced after a start
  {
    const auto a = store::OpenSqliteStore(File(0)).value();
    const auto b = store::OpenSqliteStore(File(1)).value();
    for (std::uint32_t i = 0; i < kRoutes; ++i) Put(*a, i);
    route::RouteInfo deleted = Put(*a, kRoutes);
    Put(*b, kRoutes);
    deleted.standing = route::Standing::kDeleted;
    ASSERT_TRUE(a->PutRoute(deleted));
    Put(*b, kRoutes + 1);
  }
  StartServer(0);
  StartServer(1);
  AwaitInStep();
  if (HasFatalFailure()) return;
  const auto stores = EndBoth();
  for (const auto& store : stores) {
    EXPECT_EQ(store->QueryRoutes({.page_size = 1}).value().total, kRoutes + 1);
    EXPECT_EQ(store->FindRoutesWithin("").value().size(), kRoutes + 2);
  }
}

TEST_F(MirrorServers, KilledAndCutOffAtAnyMomentLoseNothingThatWasReceipted) {
  constexpr std::uint32_t kScouts = 6;
  constexpr int kRounds = 4;
  std::mt19937 random(20090401);
  StartServer(0);
  StartServer(1);
  if (HasFatalFailure()) return;
  StartScouts(kScouts, tag_);
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t enough = Receipts() + random() % 100;
    ASSERT_TRUE(Await([&] { return Receipts() > enough; })) << Logs();
    const std::size_t victim = random() % 2;
    const std::size_t other = 1 - victim;
    const std::string gone = "'" + Name(victim) + "' is gone";
    const std::size_t before = Count(other, gone);
    ASSERT_TRUE(Await([&] { return Count(other, "'" + Name(victim) + "' is there") > before; }))
        << Logs();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 100'000));  // any moment
    // Stopped is out of reach: whoever waits for it gives it up, and has to meet it again.
    const bool killed = random() % 2 == 0;
    killed ? Kill(victim) : servers_[victim]->Signal(SIGSTOP);
    ASSERT_TRUE(Await([&] { return Count(other, gone) > before; })) << Logs();
    const std::size_t alone = Receipts() + 20;
    ASSERT_TRUE(Await([&] { return Receipts() > alone; })) << "from one: " << Logs();
    killed ? StartServer(victim) : servers_[victim]->Signal(SIGCONT);
    if (HasFatalFailure()) return;
  }
  for (const auto& scout : scouts_) scout->Finish();
  for (const auto& scout : scouts_) {
    ASSERT_TRUE(Await([&] { return scout->delivered(); })) << Logs();
  }
  // Whatever a scout is done with one of them, the other has it from that one.
  for (std::size_t which = 0; which < 2; ++which) {
    for (std::uint32_t i = 0; i < kScouts; ++i) {
      AwaitWord(which, fmt::format("'route-{}' revision 1 is complete", i));
    }
  }
  if (HasFatalFailure()) return;
  const auto stores = EndBoth();
  std::size_t taught = 0;
  for (std::uint32_t i = 0; i < kScouts; ++i) {
    const auto a = stores[0]->FindRoute(KeyNumber(i)).value();
    ASSERT_TRUE(a);
    EXPECT_EQ(a, stores[1]->FindRoute(KeyNumber(i)).value());
    EXPECT_EQ(a->state, route::RouteState::kComplete);
    EXPECT_EQ(a->standing, route::Standing::kActive);
    EXPECT_EQ(a->segment_count, scouts_[i]->taught());
    taught += scouts_[i]->taught();
    for (const SegmentIndex index : scouts_[i]->TakeReceipted()) {
      for (const auto& store : stores) {
        EXPECT_EQ(store->ReadSegment(KeyNumber(i), index).value(), TaughtPiece(i, index.value()));
      }
    }
  }
  fmt::print("{} segments of {} routes, all at both\n", taught, kScouts);
}

}  // namespace
}  // namespace trailcast::test
