#include "services/store/damaged_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kDamagedSegments = 40;

class DamagedStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    {
      const auto store = OpenSqliteStore(file_).value();
      for (std::uint32_t i = 0; i < kDamagedSegments; ++i) {
        ASSERT_TRUE(store->AppendSegments(Pieces({i})));
      }
      ASSERT_TRUE(store->PutRoute(Complete(kDamagedSegments)));
    }
    size_ = std::filesystem::file_size(file_) * 2 / 3;
    std::filesystem::resize_file(file_, size_);
    ASSERT_EQ(OpenSqliteStore(file_).error().code, ErrorCode::kCorrupt);
  }
  [[nodiscard]] std::size_t FilesThere() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(file_.parent_path()), {}));
  }

  test::TempDir dir_;
  const std::filesystem::path file_ = dir_ / "routes.db";
  std::uintmax_t size_ = 0;
};

TEST_F(DamagedStoreTest, WhatIsWholeIsReadAndWhatIsLostTold) {
  const auto damaged = OpenDamagedStore(file_);
  ASSERT_TRUE(damaged) << damaged.error().message;
  const auto held = damaged->whole->HeldSegments(kYard).value();
  EXPECT_GE(held.size(), kDamagedSegments / 2);
  EXPECT_LT(held.size(), kDamagedSegments);
  for (const SegmentIndex index : held) {
    EXPECT_EQ(damaged->whole->ReadSegment(kYard, index).value(), Piece(index.value()));
  }
  EXPECT_EQ(damaged->whole->QueryRoutes({.name = "yard"}).value().total, 1U);
  EXPECT_THAT(damaged->lost, testing::Contains(HasSubstr("segments")));
}

TEST_F(DamagedStoreTest, NothingIsWrittenAndTheFileStaysAsItIs) {
  {
    const auto damaged = OpenDamagedStore(file_).value();
    RouteStore& store = *damaged.whole;
    for (const Result<void>& refused :
         {store.AppendSegments(Pieces({kDamagedSegments})), store.PutRoute(Teaching(1)),
          store.MarkReceipted(kYard, Indices({0}))}) {
      ASSERT_FALSE(refused);
      EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable);
      EXPECT_THAT(refused.error().message, HasSubstr("read only until it is repaired"));
    }
  }
  EXPECT_EQ(std::filesystem::file_size(file_), size_);
  EXPECT_EQ(FilesThere(), 1U);
}

TEST_F(DamagedStoreTest, WhatIsNoStoreIsRefused) {
  std::ofstream(file_) << "Buy milk.\n";
  EXPECT_EQ(OpenDamagedStore(file_).error().code, ErrorCode::kCorrupt);
  EXPECT_EQ(FilesThere(), 1U);
}

}  // namespace
}  // namespace trailcast::store
