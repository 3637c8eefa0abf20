#include "services/store/salvage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kSegments = 40;

class SalvageTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto store = OpenSqliteStore(file_).value();
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      ASSERT_TRUE(store->AppendSegments(Pieces({i})));
    }
    ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
    ASSERT_TRUE(store->MarkReceipted(kYard, Indices({0, 39})));
  }
  [[nodiscard]] std::string Read() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void Write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }

  test::TempDir dir_;
  const std::filesystem::path file_ = dir_ / "routes.db";
  const std::filesystem::path saved_ = dir_ / "saved.db";
};

TEST_F(SalvageTest, OfAWholeStoreNothingIsLost) {
  const std::string before = Read();
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->routes, 1U);
  EXPECT_EQ(salvaged->segments, kSegments);
  EXPECT_THAT(salvaged->lost, IsEmpty());
  EXPECT_EQ(Read(), before);
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->FindRoute(kYard).value(), Complete(kSegments));
  EXPECT_EQ(saved->UnreceiptedSegments(kYard).value().size(), kSegments - 2);
  EXPECT_THAT(saved->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, AFlippedByteCostsTheSegmentItIsIn) {
  std::string bytes = Read();
  const route::SegmentPiece piece = Piece(7);
  const std::size_t at =
      bytes.find(std::string(piece.bytes.begin() + 200, piece.bytes.begin() + 240));
  ASSERT_NE(at, std::string::npos);
  bytes[at] ^= 1;
  Write(bytes);
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments - 1);
  EXPECT_THAT(salvaged->lost, ElementsAre(HasSubstr("segment 7 of teaching 1 of route")));
  EXPECT_EQ(OpenSqliteStore(saved_).value()->HeldSegments(kYard).value().size(), kSegments - 1);
}

TEST_F(SalvageTest, DamagedPagesCostWhatIsOnThem) {
  constexpr std::size_t kPage = 4096;
  const std::string whole = Read();
  std::size_t mended = 0;
  // The first pages define the tables: without them it is no store.
  for (std::size_t page = 20; page * kPage < whole.size(); page += 7) {
    std::string bytes = whole;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(page * kPage), kPage, '\x5A');
    Write(bytes);
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_TRUE(salvaged) << "page " << page << ": " << salvaged.error().message;
    EXPECT_GE(salvaged->segments, kSegments / 2) << "page " << page;
    const auto saved = OpenSqliteStore(saved_).value();
    EXPECT_THAT(saved->Verify().value(), IsEmpty());
    mended += salvaged->segments < kSegments ? 1 : 0;
    std::filesystem::remove(saved_);
  }
  EXPECT_GE(mended, 3U) << "hardly any page held a segment: nothing was tested";
}

// A row's number that lies before those on the page before would lead the walk round and round.
TEST_F(SalvageTest, ARowThatLiesAboutItsPlaceCostsItselfAlone) {
  constexpr std::size_t kPage = 4096;
  const std::string whole = Read();
  std::size_t damaged = 0;
  for (std::size_t page = kPage; page < whole.size(); page += kPage) {
    // https://www.sqlite.org/fileformat.html: a leaf of a table; its first cell holds two bytes of
    // length and then the row's number.
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(whole[page + at]); };
    const std::size_t cell = byte(8) * 256U + byte(9);
    if (byte(0) != 0x0D || whole.find(kYard.route.value(), page + cell) > page + cell + 40)
      continue;
    if (byte(cell) < 0x80 || byte(cell + 2) <= 1) continue;
    std::string bytes = whole;
    bytes[page + cell + 2] = 1;
    Write(bytes);
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_TRUE(salvaged) << salvaged.error().message;
    EXPECT_EQ(salvaged->segments, kSegments - 1) << "page at " << page;
    EXPECT_THAT(OpenSqliteStore(saved_).value()->Verify().value(), IsEmpty());
    std::filesystem::remove(saved_);
    ++damaged;
  }
  EXPECT_GT(damaged, 3U);
}

TEST_F(SalvageTest, AStoreCutShortKeepsWhatIsLeft) {
  const std::string whole = Read();
  Write(whole.substr(0, whole.size() * 2 / 3));
  ASSERT_FALSE(OpenSqliteStore(file_));
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_GE(salvaged->segments, kSegments / 2);
  EXPECT_LT(salvaged->segments, kSegments);
  EXPECT_THAT(OpenSqliteStore(saved_).value()->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, WhatWasDeletedStaysDeleted) {
  const route::RouteKey gone{RouteId(std::string(32, '9')), TeachingId(1)};
  {
    const auto store = OpenSqliteStore(file_).value();
    route::RouteInfo tombstone = Complete(1);
    tombstone.key = gone;
    tombstone.standing = route::Standing::kDeleted;
    tombstone.edition = 1;
    ASSERT_TRUE(store->PutRoute(tombstone));
  }
  ASSERT_TRUE(Salvage(file_, saved_));
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->FindRoute(gone).value()->standing, route::Standing::kDeleted);
}

TEST_F(SalvageTest, SegmentsThatRelyOnOthersBytesAreSavedWithThem) {
  route::SegmentPiece again = Piece(3);
  again.key.teaching = TeachingId(2);
  {
    const auto store = OpenSqliteStore(file_).value();
    ASSERT_TRUE(store->AppendSegments({&again, 1}));
    ASSERT_TRUE(store->MarkReceipted(again.key, {&again.index, 1}));
  }
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ(salvaged->segments, kSegments + 1);
  const auto saved = OpenSqliteStore(saved_).value();
  EXPECT_EQ(saved->ReadSegment(again.key, again.index).value(), again);
  EXPECT_THAT(saved->UnreceiptedSegments(again.key).value(), IsEmpty());
}

TEST_F(SalvageTest, WithoutRoomForItNothingIsMade) {
  const auto salvaged = Salvage(file_, saved_, {.max_bytes = 120'000});
  ASSERT_FALSE(salvaged);
  EXPECT_EQ(salvaged.error().code, ErrorCode::kUnavailable);
  EXPECT_FALSE(std::filesystem::exists(saved_));
  EXPECT_THAT(OpenSqliteStore(file_).value()->Verify().value(), IsEmpty());
}

TEST_F(SalvageTest, WhatIsNoStoreOrInUseIsRefused) {
  {
    const auto in_use = OpenSqliteStore(file_).value();
    const auto salvaged = Salvage(file_, saved_);
    ASSERT_FALSE(salvaged);
    EXPECT_EQ(salvaged.error().code, ErrorCode::kConflict);
  }
  Write("Buy milk.\n");
  const auto salvaged = Salvage(file_, saved_);
  ASSERT_FALSE(salvaged);
  EXPECT_EQ(salvaged.error().code, ErrorCode::kCorrupt);
  EXPECT_FALSE(std::filesystem::exists(saved_));
  EXPECT_FALSE(Salvage(dir_ / "nowhere.db", saved_));
  Write("");
  EXPECT_FALSE(Salvage(file_, file_));
}

}  // namespace
}  // namespace trailcast::store
