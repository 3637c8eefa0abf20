#include "services/exchange/batches.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

TEST(SplitBatch, KeepsPiecesInOrderAndBatchesSmall) {
  const auto pieces = test::PiecesOf(test::KeyNumber(1), 100, 3000);
  const auto batches = SplitBatch({AgentId("s"), pieces});
  std::vector<route::SegmentPiece> joined;
  for (const SegmentBatch& batch : batches) {
    std::size_t size = 0;
    for (const auto& piece : batch.pieces) size += WireSize(piece);
    EXPECT_LE(size, kBatchBytes);
    EXPECT_EQ(batch.sender, AgentId("s"));
    joined.insert(joined.end(), batch.pieces.begin(), batch.pieces.end());
  }
  EXPECT_EQ(joined, pieces);
  EXPECT_EQ(batches.size(), 7U);  // 15 pieces of 3096 bytes fit 48 KiB
}

TEST(SplitBatch, DoesNotMixRoutes) {
  const auto hall = test::KeyNumber(1);
  const auto yard = test::KeyNumber(1, 2);
  const auto batches = SplitBatch(
      {AgentId("s"), {test::PieceOf(hall, 0), test::PieceOf(hall, 1), test::PieceOf(yard, 0)}});
  ASSERT_EQ(batches.size(), 2U);
  EXPECT_EQ(batches[0].pieces.size(), 2U);
  EXPECT_EQ(batches[1].pieces, std::vector{test::PieceOf(yard, 0)});
}

TEST(SplitBatch, SendsALargePieceAlone) {
  const auto key = test::KeyNumber(1);
  const auto batches =
      SplitBatch({AgentId("s"),
                  {test::PieceOf(key, 0), test::PieceOf(key, 1, 200'000), test::PieceOf(key, 2)}});
  ASSERT_EQ(batches.size(), 3U);
  EXPECT_EQ(batches[1].pieces.size(), 1U);
}

TEST(SplitBatch, MakesNothingOfNothing) { EXPECT_TRUE(SplitBatch({AgentId("s"), {}}).empty()); }

}  // namespace
}  // namespace trailcast::exchange
