#include "services/records/age_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using testing::ElementsAre;

const route::RouteKey kHall{RouteId(std::string(32, 'a')), TeachingId(7)};
const route::RouteKey kYard{RouteId(std::string(32, 'b')), TeachingId(7)};
constexpr std::int64_t kMark = 1'700'000'000'000;

class AgeStoreTest : public testing::Test {
 protected:
  void SetUp() override { Restart(); }
  void Restart() {
    ages_.reset();
    auto ages = AgeStore::Open(folder_ / "ages");
    ASSERT_TRUE(ages) << ages.error().message;
    ages_ = *std::move(ages);
  }
  milliseconds AgeOf(const route::RouteKey& key, std::int64_t mark = kMark) {
    const auto ages = ages_->AgesOf({{key, mark}});
    EXPECT_TRUE(ages) << ages.error().message;
    return ages ? ages->at(0) : milliseconds(-1);
  }

  test::TempDir folder_;
  std::unique_ptr<AgeStore> ages_;
};

TEST_F(AgeStoreTest, ARevisionIsAsOldAsTheTimeThatItWasSeenToLie) {
  EXPECT_EQ(AgeOf(kHall), milliseconds(0));
  ASSERT_TRUE(ages_->Pass(hours(3)));
  EXPECT_EQ(AgeOf(kHall), hours(3));
  EXPECT_EQ(AgeOf(kYard), milliseconds(0));
  ASSERT_TRUE(ages_->Pass(hours(1)));
  EXPECT_THAT(ages_->AgesOf({{kYard, kMark}, {kHall, kMark}}).value(),
              ElementsAre(hours(1), hours(4)));
}

// Whatever the clock says by which its store marks it: 1970, or ten years ahead.
TEST_F(AgeStoreTest, AMarkIsNoTime) {
  for (const std::int64_t mark : {std::int64_t{0}, kMark, 2 * kMark}) {
    EXPECT_EQ(AgeOf(kHall, mark), milliseconds(0)) << "it has grown";
    ASSERT_TRUE(ages_->Pass(hours(1)));
    EXPECT_EQ(AgeOf(kHall, mark), hours(1));
  }
}

TEST_F(AgeStoreTest, TimeThatPassedIsKeptOverARestartAndNoneIsMadeUp) {
  (void)AgeOf(kHall);
  ASSERT_TRUE(ages_->Pass(hours(5)));
  Restart();
  EXPECT_EQ(AgeOf(kHall), hours(5));
  ASSERT_TRUE(ages_->Pass(AgeStore::kKeptEvery - milliseconds(1)));
  Restart();
  EXPECT_EQ(AgeOf(kHall), hours(5)) << "a commit a minute does";
  ASSERT_TRUE(ages_->Pass(minutes(1) - milliseconds(1)));
  EXPECT_EQ(AgeOf(kYard), milliseconds(0));
  Restart();
  EXPECT_EQ(AgeOf(kYard), milliseconds(0)) << "nothing is of a time that is yet to come";
  EXPECT_EQ(AgeOf(kHall), hours(5) + minutes(1) - milliseconds(1));
}

TEST_F(AgeStoreTest, SoManyADayAreDeletedAlsoByAServerThatStartsAgainAndAgain) {
  EXPECT_EQ(ages_->Allow(60, 100).value(), 60U);
  Restart();
  EXPECT_EQ(ages_->Allow(60, 100).value(), 40U);
  Restart();
  EXPECT_EQ(ages_->Allow(60, 100).value(), 0U);
  EXPECT_EQ(ages_->Allow(60, 110).value(), 10U) << "somebody wants more";
  ASSERT_TRUE(ages_->Pass(hours(24)));
  EXPECT_EQ(ages_->Allow(500, 100).value(), 100U);
}

TEST_F(AgeStoreTest, AnotherFileIsNotTaken) {
  ages_.reset();
  std::ofstream(folder_ / "ages", std::ios::trunc) << std::string(4096, 'x');
  const auto ages = AgeStore::Open(folder_ / "ages");
  ASSERT_FALSE(ages);
  EXPECT_EQ(ages.error().code, ErrorCode::kCorrupt);
  EXPECT_TRUE(AgeStore::Open(":memory:"));
}

}  // namespace
}  // namespace trailcast::store
