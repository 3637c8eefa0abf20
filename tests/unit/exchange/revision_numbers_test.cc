#include "services/exchange/revision_numbers.h"

#include <gtest/gtest.h>

#include "tests/support/memory_store.h"

namespace trailcast::exchange {
namespace {

class GiveNumbersTest : public testing::Test {
 protected:
  // The numbers that teachings of one route get which claim these.
  std::vector<std::uint32_t> Give(
      const std::vector<std::pair<std::uint64_t, std::uint32_t>>& told) {
    std::vector<route::RouteInfo> infos;
    for (const auto& [teaching, revision] : told) {
      infos.push_back(test::InfoOf(test::KeyNumber(1, teaching), {}, route::RouteState::kTeaching));
      infos.back().revision = RevisionNumber(revision);
    }
    EXPECT_TRUE(GiveNumbers(store_, infos));
    EXPECT_TRUE(store_.PutRoutes(infos));
    std::vector<std::uint32_t> numbers;
    for (const route::RouteInfo& info : infos) numbers.push_back(info.revision.value());
    return numbers;
  }
  using Numbers = std::vector<std::uint32_t>;
  test::MemoryStore store_;
};

TEST_F(GiveNumbersTest, WhoComesSecondWithANumberGetsTheNext) {
  EXPECT_EQ(Give({{77, 1}}), Numbers{1});
  EXPECT_EQ(Give({{55, 2}, {99, 2}}), (Numbers{2, 3}));
  EXPECT_EQ(Give({{99, 2}}), Numbers{3}) << "and keeps it";
  EXPECT_EQ(Give({{11, 0}}), Numbers{4});
}

TEST_F(GiveNumbersTest, ANumberIsNotGivenTwiceThoughItsTeachingWasDeleted) {
  Give({{77, 1}, {55, 2}});
  route::RouteInfo gone = **store_.FindRoute(test::KeyNumber(1, 55));
  gone.standing = route::Standing::kDeleted;
  gone.edition = 1;
  ASSERT_TRUE(store_.PutRoute(gone));
  EXPECT_EQ(Give({{99, 2}}), Numbers{3});
}

TEST_F(GiveNumbersTest, ANewServerGivesTheNumbersThatTeachingsHad) {
  EXPECT_EQ(Give({{99, 5}}), Numbers{5});
  EXPECT_EQ(Give({{77, 3}}), Numbers{3});
}

}  // namespace
}  // namespace trailcast::exchange
