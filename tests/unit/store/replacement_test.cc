#include "services/store/src/salvage/replacement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/store/salvage.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kBefore = 40;
constexpr std::uint32_t kAfter = 10;
constexpr std::size_t kSteps = 4;
constexpr std::size_t kNewOneCounts = 2;  // from so many steps on

void FillAnew(RouteStore& store, std::uint32_t segments) {
  for (std::uint32_t i = 0; i < segments; ++i) ASSERT_TRUE(store.AppendSegments(Pieces({i})));
}

// A store whose segments are all in its log, and another to take its place.
class ReplacementTest : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    const fs::path open = dir_ / "open.db";
    const auto store = OpenSqliteStore(open).value();
    FillAnew(*store, kBefore);
    for (const char* part : {"", "-wal"})
      fs::copy_file(open.string() + part, file_.string() + part);
    FillAnew(*OpenSqliteStore(replacement_.made()).value(), kAfter);
  }
  static std::size_t HeldIn(const fs::path& file) {
    const auto store = OpenSqliteStore(file);
    if (!store) return 0;
    EXPECT_THAT((*store)->Verify().value(), testing::IsEmpty());
    return (*store)->HeldSegments(kYard).value().size();
  }

  test::TempDir dir_;
  const fs::path file_ = dir_ / "routes.db";
  const Replacement replacement_{file_};
};

TEST_P(ReplacementTest, WhereverItIsCutOffOneStoreIsThereWithItsOwnLog) {
  const auto steps = replacement_.steps();
  ASSERT_EQ(steps.size(), kSteps);
  for (std::size_t i = 0; i < GetParam(); ++i) ASSERT_TRUE(steps[i]());
  const bool is_new = GetParam() >= kNewOneCounts;
  EXPECT_EQ(HeldIn(file_), is_new ? kAfter : kBefore);
  EXPECT_EQ(HeldIn(file_), is_new ? kAfter : kBefore) << "opened again";
  EXPECT_EQ(HeldIn(is_new ? replacement_.kept() : file_), kBefore);
  const auto again = Repair(file_);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->salvaged.segments, is_new ? kAfter : kBefore);
  EXPECT_EQ(HeldIn(file_), is_new ? kAfter : kBefore);
  EXPECT_EQ(fs::exists(replacement_.made()), false);
}

INSTANTIATE_TEST_SUITE_P(AfterStep, ReplacementTest, testing::Range<std::size_t>(0, kSteps + 1));

}  // namespace
}  // namespace trailcast::store
