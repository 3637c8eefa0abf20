// A server that is killed again and again while twenty scouts teach.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <random>
#include <thread>

#include "services/dds/dds_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_sender.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "tests/support/pieces.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::uint32_t kScouts = 20;
constexpr milliseconds kTeachEvery{100};
constexpr std::chrono::seconds kPatience{60};

// All rounds: TRAILCAST_KILL_ROUNDS=100.
int Rounds() {
  const char* wanted = std::getenv("TRAILCAST_KILL_ROUNDS");  // NOLINT(concurrency-mt-unsafe)
  return wanted == nullptr ? 5 : std::atoi(wanted);
}

// As large as a segment of some fifty features, with the digest that a server expects.
route::SegmentPiece TaughtPiece(std::uint32_t scout, std::uint32_t index) {
  route::SegmentPiece piece =
      PieceOf(KeyNumber(scout), index, 5000, static_cast<std::uint8_t>(scout));
  piece.digest = route::Sha256(piece.bytes);
  return piece;
}

// Teaches a segment every so often until Finish, on a thread of its own.
class KillScout {
 public:
  KillScout(std::uint32_t number, const std::string& tag)
      : number_(number), tag_(tag), thread_([this] { Run(); }) {}
  ~KillScout() { give_up_ = true; }
  KillScout(const KillScout&) = delete;
  KillScout& operator=(const KillScout&) = delete;

  void Finish() { finish_ = true; }
  [[nodiscard]] bool delivered() const { return delivered_; }
  [[nodiscard]] std::uint32_t taught() const { return taught_; }
  // Indices receipted since the last call.
  std::vector<SegmentIndex> TakeReceipted() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(receipted_, {});
  }
  [[nodiscard]] std::size_t receipts() const { return receipts_; }

 private:
  route::RouteInfo Info(route::RouteState state) const {
    route::RouteInfo info;
    info.key = KeyNumber(number_);
    info.name = fmt::format("route-{}", number_);
    info.scout = AgentId(fmt::format("scout-{}", number_));
    info.state = state;
    info.segment_count = static_cast<std::uint32_t>(digests_.size());
    info.length_m = 2.0 * info.segment_count;
    info.bytes = 5000ULL * info.segment_count;
    info.manifest_digest = route::ManifestDigest(digests_);
    return info;
  }

  void Run() {
    dds::DdsOptions options;
    options.discovery_tag = tag_;
    options.network_interface = "lo";
    options.self = AgentId(fmt::format("scout-{}", number_));
    const auto exchange = dds::OpenDdsExchange(options, exchange::ScoutTopics());
    if (!exchange) return;
    const auto read = [this](SegmentIndex index) -> Result<route::SegmentPiece> {
      return TaughtPiece(number_, index.value());
    };
    exchange::RouteSender sender(options.self, Info(route::RouteState::kTeaching), read, {});
    auto teach_at = Clock::now();
    bool finished = false;
    while (!give_up_ && !delivered_) {
      for (const exchange::Message& message : (*exchange)->Take(milliseconds(10))) {
        sender.Handle(message, Clock::now());
      }
      if (!finish_ && Clock::now() >= teach_at) {
        const route::SegmentPiece piece = TaughtPiece(number_, taught_);
        digests_.push_back(piece.digest);
        sender.Add(piece, Info(route::RouteState::kTeaching));
        ++taught_;
        teach_at += kTeachEvery;
      }
      if (finish_ && !finished) sender.Update(Info(route::RouteState::kComplete));
      finished = finish_;
      // What cannot be sent is asked for.
      (void)exchange::PublishAll(**exchange, sender.Tick(Clock::now()));
      const auto receipted = sender.TakeNewlyReceipted();
      const std::scoped_lock lock(mutex_);
      receipted_.insert(receipted_.end(), receipted.begin(), receipted.end());
      receipts_ += receipted.size();
      delivered_ = finished && sender.AllReceipted();
    }
  }

  std::uint32_t number_;
  std::string tag_;
  std::vector<route::Digest> digests_;
  std::atomic<bool> finish_{false};
  std::atomic<bool> give_up_{false};
  std::atomic<bool> delivered_{false};
  std::atomic<std::uint32_t> taught_{0};
  std::atomic<std::size_t> receipts_{0};
  std::mutex mutex_;  // guards receipted_
  std::vector<SegmentIndex> receipted_;
  std::jthread thread_;
};

class ServerKill : public testing::Test {
 protected:
  void SetUp() override {
    for (std::uint32_t i = 0; i < kScouts; ++i) {
      scouts_.push_back(std::make_unique<KillScout>(i, tag_));
    }
  }
  void StartServer() {
    server_ = std::make_unique<Process>(
        std::vector<std::string>{std::string(TRAILCAST_BINARY_DIR) + "/trailcast-server",
                                 "--dds-tag", tag_, "--network-interface", "lo", "--store",
                                 file_.string()},
        (folder_ / "server.log").string());
    ASSERT_TRUE(server_->WaitForOutput("ready")) << server_->output();
  }
  [[nodiscard]] std::size_t Receipts() const {
    std::size_t receipts = 0;
    for (const auto& scout : scouts_) receipts += scout->receipts();
    return receipts;
  }
  // False if that takes too long.
  template <typename Condition>
  static bool Await(const Condition& condition) {
    const auto deadline = Clock::now() + kPatience;
    while (!condition() && Clock::now() < deadline) std::this_thread::sleep_for(milliseconds(1));
    return condition();
  }
  // Nobody has the store open: all that was receipted is in it, byte for byte.
  void ExpectReceiptedIsHeld() {
    auto store = store::OpenSqliteStore(file_);
    ASSERT_TRUE(store) << store.error().message;
    for (std::uint32_t i = 0; i < kScouts; ++i) {
      for (const SegmentIndex index : scouts_[i]->TakeReceipted()) {
        const auto held = (*store)->ReadSegment(KeyNumber(i), index);
        ASSERT_TRUE(held) << held.error().message;
        ASSERT_EQ(*held, TaughtPiece(i, index.value()));
        ++checked_;
      }
    }
  }

  TempDir folder_;
  const std::filesystem::path file_ = folder_ / "server.db";
  const std::string tag_ = fmt::format("kill-{}", getpid());
  std::vector<std::unique_ptr<KillScout>> scouts_;
  std::unique_ptr<Process> server_;
  std::size_t checked_ = 0;
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
