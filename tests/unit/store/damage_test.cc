#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include "services/store/route_store.h"
#include "services/store/src/row_values.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kSegments = 30;

class StoreDamage : public testing::Test {
 protected:
  void SetUp() override {
    auto store = OpenSqliteStore(file_).value();
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      ASSERT_TRUE(store->AppendSegments(Pieces({i})));
    }
    ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
    store.reset();
    std::ifstream in(file_, std::ios::binary);
    whole_ = {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void Write(const std::string& content) const {
    std::ofstream(file_, std::ios::binary) << content;
  }
  // Where some bytes of a segment, well inside it, lie in the file.
  [[nodiscard]] std::size_t Locate(std::uint32_t index, std::size_t offset = 2500) const {
    const route::Bytes bytes = Piece(index).bytes;
    const std::string needle(bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                             bytes.begin() + static_cast<std::ptrdiff_t>(offset) + 32);
    return whole_.find(needle);
  }
  [[nodiscard]] std::string Flipped(std::size_t at) const {
    std::string damaged = whole_;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
    return damaged;
  }

  test::TempDir dir_;
  const std::filesystem::path file_ = dir_ / "routes.db";
  std::string whole_;
};

TEST_F(StoreDamage, ChangedByteInASegmentIsCorruptAndTheOthersStillRead) {
  ASSERT_NE(Locate(7), std::string::npos);
  Write(Flipped(Locate(7)));
  auto store = OpenSqliteStore(file_).value();
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const auto read = store->ReadSegment(kYard, SegmentIndex(i));
    if (i != 7) {
      ASSERT_EQ(read.value(), Piece(i));
      continue;
    }
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
    EXPECT_THAT(read.error().message, HasSubstr("segment 7 of teaching 1 of route"));
    EXPECT_THAT(read.error().message, HasSubstr(file_.string()));
  }
  EXPECT_THAT(store->Verify().value(),
              testing::ElementsAre(HasSubstr("segment 7 of teaching 1 of route")));
}

TEST_F(StoreDamage, DamagedSegmentMendsWhenItIsAppendedAgain) {
  Write(Flipped(Locate(7)));
  auto store = OpenSqliteStore(file_).value();
  ASSERT_TRUE(store->AppendSegments(Pieces({6, 7})));
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(7)).value(), Piece(7));
  EXPECT_THAT(store->Verify().value(), IsEmpty());
}

TEST_F(StoreDamage, ADamagedRowAroundWholeBytesMendsWithThem) {
  const route::Digest seal = Seal(Piece(7));
  const std::size_t at = whole_.find(std::string(seal.begin(), seal.end()));
  ASSERT_NE(at, std::string::npos);
  Write(Flipped(at));
  auto store = OpenSqliteStore(file_).value();
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(7)).error().code, ErrorCode::kCorrupt);
  ASSERT_TRUE(store->AppendSegments(Pieces({7})));
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(7)).value(), Piece(7));
  EXPECT_THAT(store->Verify().value(), IsEmpty());
}

TEST_F(StoreDamage, ChangedByteInARouteIsCorruptUntilItIsAnnouncedAgain) {
  const std::size_t camera = whole_.find("webcam 320x240");
  ASSERT_NE(camera, std::string::npos);
  Write(Flipped(camera));
  auto store = OpenSqliteStore(file_).value();
  const auto found = store->FindRoute(kYard);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(found.error().message, HasSubstr("named 'yard'"));
  EXPECT_FALSE(store->ListRoutes());
  EXPECT_THAT(store->Verify().value(), Contains(HasSubstr("what is known of teaching 1 of route")));
  EXPECT_EQ(store->ReadSegment(kYard, SegmentIndex(3)).value(), Piece(3));
  ASSERT_TRUE(store->PutRoute(Complete(kSegments)));
  EXPECT_EQ(store->FindRoute(kYard).value(), Complete(kSegments));
}

TEST_F(StoreDamage, PageOfZerosIsSaidToBeCorruptAndMostSegmentsStillRead) {
  std::string damaged = whole_;
  const std::size_t page = Locate(7) / 4096 * 4096;
  std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(page), 4096, '\0');
  Write(damaged);
  auto store = OpenSqliteStore(file_).value();
  int whole = 0;
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const auto read = store->ReadSegment(kYard, SegmentIndex(i));
    if (read) {
      ASSERT_EQ(*read, Piece(i));
      ++whole;
    } else {
      EXPECT_EQ(read.error().code, ErrorCode::kCorrupt) << read.error().message;
    }
  }
  EXPECT_GE(whole, static_cast<int>(kSegments) - 8);
  EXPECT_LT(whole, static_cast<int>(kSegments));
  EXPECT_FALSE(store->Verify().value().empty());
}

// Whatever is damaged: no crash, no wrong bytes; an error or what was stored.
TEST_F(StoreDamage, RandomDamageAnywhereNeverYieldsWrongBytes) {
  std::mt19937 random(20090401);
  int opened = 0;
  for (int round = 0; round < 60; ++round) {
    std::string damaged = whole_;
    for (int change = 0; change < 20; ++change) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    Write(damaged);
    const auto store = OpenSqliteStore(file_);
    if (!store) {
      EXPECT_EQ(store.error().code, ErrorCode::kCorrupt) << store.error().message;
      continue;
    }
    ++opened;
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const auto read = (*store)->ReadSegment(kYard, SegmentIndex(i));
      if (read) {
        ASSERT_EQ(*read, Piece(i));
      }
    }
    const auto found = (*store)->FindRoute(kYard);
    if (found && found->has_value()) {
      EXPECT_EQ(**found, Complete(kSegments));
    }
    const auto damage = (*store)->Verify();
    ASSERT_TRUE(damage) << damage.error().message;
  }
  EXPECT_GT(opened, 10) << "most damage lies in segments, which opening does not read";
}

}  // namespace
}  // namespace trailcast::store
