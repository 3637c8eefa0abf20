#include "tests/soak/ledger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"

namespace trailcast::soak {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class LedgerTest : public testing::Test {
 protected:
  void SetUp() override {
    store_ = store::OpenSqliteStore(folder_ / "store.db").value();
    ledger_.NoteTaught(taught_.info.key, taught_.pieces);
  }
  void Store(std::size_t segments) {
    ASSERT_TRUE(store_->PutRoute(taught_.info));
    ASSERT_TRUE(store_->AppendSegments(std::span(taught_.pieces).first(segments)));
  }
  [[nodiscard]] exchange::Receipt Receipt(std::uint32_t prefix,
                                          const std::vector<SegmentIndex>& beyond = {}) const {
    return test::ReceiptFor(AgentId("server"), taught_.info.key, taught_.pieces, prefix, beyond);
  }

  test::TempDir folder_;
  test::TaughtRoute taught_ = test::TeachSamples(5);
  std::unique_ptr<store::RouteStore> store_;
  Ledger ledger_;
};

TEST_F(LedgerTest, WhatWasReceiptedAndIsThereIsNotLost) {
  Store(5);
  ledger_.Note(Receipt(2, {SegmentIndex(4)}));
  ledger_.Note(Receipt(2, {SegmentIndex(4)}));
  EXPECT_THAT(ledger_.LostIn(*store_), IsEmpty());
  EXPECT_EQ(ledger_.receipted(), 3U);
  EXPECT_EQ(ledger_.checked(), 3U);
}

TEST_F(LedgerTest, WhatWasReceiptedAndIsMissingIsLost) {
  Store(3);
  ledger_.Note(Receipt(2, {SegmentIndex(4)}));
  EXPECT_THAT(ledger_.LostIn(*store_), SizeIs(1));
}

TEST_F(LedgerTest, WhatOnceWasReceiptedStaysSoWhenALaterReceiptSaysLess) {
  Store(3);
  ledger_.Note(Receipt(5));
  ledger_.Note(Receipt(3));
  EXPECT_THAT(ledger_.LostIn(*store_), SizeIs(2));
}

TEST_F(LedgerTest, OtherBytesThanTheTaughtOnesAreALoss) {
  Store(5);
  auto other = taught_.pieces;
  std::swap(other[0].bytes, other[1].bytes);
  ledger_.NoteTaught(taught_.info.key, other);
  ledger_.Note(Receipt(5));
  const auto lost = ledger_.LostIn(*store_);
  ASSERT_THAT(lost, SizeIs(2));
  EXPECT_THAT(lost[0], HasSubstr("not the one that was taught"));
}

TEST_F(LedgerTest, WhatWasDeletedMayGoAndMustNotComeBack) {
  Store(5);
  ledger_.Note(Receipt(5));
  ledger_.Forget(taught_.info.key);
  ledger_.Note(Receipt(5));  // a late one
  EXPECT_THAT(ledger_.LostIn(*store_), IsEmpty());
  EXPECT_THAT(ledger_.UndeletedIn(*store_), IsEmpty());
  ledger_.NoteDeleted(taught_.info.key);
  EXPECT_THAT(ledger_.UndeletedIn(*store_), SizeIs(1));
  taught_.info.standing = route::Standing::kDeleted;
  ++taught_.info.edition;
  ASSERT_TRUE(store_->PutRoute(taught_.info));
  EXPECT_THAT(ledger_.UndeletedIn(*store_), IsEmpty());
}

}  // namespace
}  // namespace trailcast::soak
