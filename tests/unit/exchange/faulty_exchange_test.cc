#include "tests/support/faulty_exchange.h"

#include <gtest/gtest.h>

#include "services/exchange/in_process_exchange.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

constexpr std::chrono::milliseconds kNow{0};
constexpr std::uint32_t kCount = 1000;

class FaultyExchangeTest : public testing::Test {
 protected:
  // The indices, in order of arrival, of kCount batches of one piece each.
  std::vector<route::SegmentPiece> ReceiveAll(const Faults& faults, std::uint32_t seed) {
    const auto writer = bus_.Open({.write = {Topic::kSegments}, .read = {}});
    FaultyExchange reader(bus_.Open({.write = {}, .read = {Topic::kSegments}}), faults, seed);
    std::vector<route::SegmentPiece> got;
    const auto take = [&] {
      for (auto& piece : test::PiecesIn(reader.Take(kNow))) got.push_back(std::move(piece));
    };
    for (const auto& piece : sent_) {
      EXPECT_TRUE(writer->Publish(SegmentBatch{AgentId("s"), {piece}}));
      take();
    }
    for (int i = 0; i < faults.max_delay_takes; ++i) take();
    return got;
  }

  InProcessBus bus_;
  const std::vector<route::SegmentPiece> sent_ = test::PiecesOf(test::KeyNumber(1), kCount, 20);
};

TEST_F(FaultyExchangeTest, WithoutFaultsIsTransparent) { EXPECT_EQ(ReceiveAll({}, 1), sent_); }

TEST_F(FaultyExchangeTest, DropsAndDuplicatesTheSharesAskedFor) {
  EXPECT_NEAR(static_cast<double>(ReceiveAll({.drop = 0.2}, 1).size()), 800.0, 60.0);
  EXPECT_NEAR(static_cast<double>(ReceiveAll({.duplicate = 0.2}, 1).size()), 1200.0, 60.0);
}

TEST_F(FaultyExchangeTest, DelayReordersAndLosesNothing) {
  auto got = ReceiveAll({.delay = 0.3}, 1);
  EXPECT_NE(got, sent_);
  std::sort(got.begin(), got.end(), [](auto& a, auto& b) { return a.index < b.index; });
  EXPECT_EQ(got, sent_);
}

TEST_F(FaultyExchangeTest, CorruptBytesFailTheirDigest) {
  int bad = 0;
  for (const auto& piece : ReceiveAll({.corrupt = 0.5}, 1)) {
    if (!test::ToyIntegrity().check_piece(piece)) ++bad;
  }
  EXPECT_NEAR(bad, 500, 60);
}

TEST_F(FaultyExchangeTest, RepeatsItselfForTheSameSeedOnly) {
  const Faults faults{.drop = 0.2, .duplicate = 0.2, .delay = 0.2, .corrupt = 0.2};
  EXPECT_EQ(ReceiveAll(faults, 7), ReceiveAll(faults, 7));
  EXPECT_NE(ReceiveAll(faults, 7), ReceiveAll(faults, 8));
}

TEST_F(FaultyExchangeTest, CutOffLosesBothWaysAndRefusingSaysSo) {
  const TopicUse both{.write = {Topic::kSegments}, .read = {Topic::kSegments}};
  const auto peer = bus_.Open(both);
  FaultyExchange faulty(bus_.Open(both), {}, 1);
  const SegmentBatch batch{AgentId("s"), {sent_[0]}};
  faulty.set_cut_off(true);
  EXPECT_TRUE(faulty.Publish(batch));
  EXPECT_TRUE(peer->Publish(batch));
  EXPECT_TRUE(faulty.Take(kNow).empty());
  EXPECT_TRUE(peer->Take(kNow).empty());
  faulty.set_cut_off(false);
  EXPECT_TRUE(faulty.Take(kNow).empty());
  faulty.set_refusing(true);
  const auto refused = faulty.Publish(batch);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace trailcast::exchange
