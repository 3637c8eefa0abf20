#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "services/dds/dds_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_sender.h"
#include "services/route/digest.h"
#include "services/store/route_store.h"
#include "tests/support/await.h"
#include "tests/support/pieces.h"

namespace trailcast::test {

// Returns a piece as large as a segment of some fifty features, with the digest that a server
// expects.
[[nodiscard]] inline route::SegmentPiece TaughtPiece(std::uint32_t scout, std::uint32_t index) {
  route::SegmentPiece piece =
      PieceOf(KeyNumber(scout), index, 5000, static_cast<std::uint8_t>(scout));
  piece.digest = route::Sha256(piece.bytes);
  return piece;
}

// This teaches a segment every so often until Finish, on a thread of its own.
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
  // Returns the indices acknowledged since the last call.
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
    using Clock = std::chrono::steady_clock;
    using std::chrono::milliseconds;
    constexpr milliseconds kTeachEvery{100};
    dds::DdsOptions options;
    options.discovery_tag = tag_;
    options.network_interface = "lo";
    options.self = AgentId(fmt::format("scout-{}", number_));
    const auto exchange = dds::OpenDdsExchange(options, exchange::ScoutTopics());
    if (!exchange) return;
    const auto read = [this](SegmentIndex index) -> Result<route::SegmentPiece> {
      return TaughtPiece(number_, index.value());
    };
    exchange::RouteSender sender(options.self, Info(route::RouteState::kTeaching), read, {}, {});
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
      // A piece that cannot be sent is asked for.
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

// These are several of them, and what servers told them.
class KillScoutsTest : public testing::Test {
 protected:
  void StartScouts(std::uint32_t count, const std::string& tag) {
    for (std::uint32_t i = 0; i < count; ++i) {
      scouts_.push_back(std::make_unique<KillScout>(i, tag));
    }
  }
  [[nodiscard]] std::size_t Receipts() const {
    std::size_t receipts = 0;
    for (const auto& scout : scouts_) receipts += scout->receipts();
    return receipts;
  }
  // Returns false if that takes too long.
  template <typename Condition>
  static bool Await(const Condition& condition) {
    const auto deadline = std::chrono::steady_clock::now() + test::kLongEnough;
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
  }
  // Returns whether all that was acknowledged is in the store, byte for byte.
  void ExpectReceiptedIsHeld(Result<std::unique_ptr<store::RouteStore>> store) {
    ASSERT_TRUE(store) << store.error().message;
    for (std::uint32_t i = 0; i < scouts_.size(); ++i) {
      for (const SegmentIndex index : scouts_[i]->TakeReceipted()) {
        const auto held = (*store)->ReadSegment(KeyNumber(i), index);
        ASSERT_TRUE(held) << held.error().message;
        ASSERT_EQ(*held, TaughtPiece(i, index.value()));
        ++checked_;
      }
    }
  }

  std::vector<std::unique_ptr<KillScout>> scouts_;
  std::size_t checked_ = 0;
};

}  // namespace trailcast::test
