#include "services/catalog/partial_routes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"

namespace trailcast::catalog {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using testing::ElementsAre;
using testing::IsEmpty;

class PartialRoutesTest : public testing::Test {
 protected:
  static constexpr PartialRoutes::Time kStart{};
  // A complete route of four segments, of which the store has the first few.
  void Store(unsigned number, std::uint32_t held) {
    const route::RouteKey key = test::KeyNumber(number);
    ASSERT_TRUE(store_.AppendSegments(test::PiecesOf(key, held)));
    ASSERT_TRUE(
        store_.PutRoute(test::InfoOf(key, test::PiecesOf(key, 4), route::RouteState::kComplete)));
  }
  // Returns what is told, as "segments", of one route at a time.
  std::vector<std::string> Told(PartialRoutes::Time now) {
    std::vector<std::string> told;
    for (const store::LackingRoute& route : partial_.TakeUntold(now)) {
      told.push_back(store::DescribeSegments(route.segments));
    }
    return told;
  }

  test::MemoryStore store_;
  PartialRoutes partial_{store_};
};

TEST_F(PartialRoutesTest, WhatACompleteRouteLacksIsToldNowAndAgainAnHourLater) {
  Store(1, 4);
  Store(2, 1);
  EXPECT_THAT(partial_.Look().value(), ElementsAre(test::KeyNumber(2)));
  EXPECT_EQ(partial_.routes(), 1U);
  EXPECT_EQ(partial_.segments(), 3U);
  EXPECT_EQ(partial_.LackingOf(test::KeyNumber(1)), 0U);
  EXPECT_EQ(partial_.LackingOf(test::KeyNumber(2)), 3U);
  EXPECT_THAT(Told(kStart), ElementsAre("segments 1 to 3"));
  EXPECT_THAT(partial_.Look().value(), ElementsAre(test::KeyNumber(2)));
  EXPECT_THAT(Told(kStart + minutes(59)), IsEmpty());
  EXPECT_THAT(Told(kStart + hours(1)), ElementsAre("segments 1 to 3"));
}

TEST_F(PartialRoutesTest, ARouteBeingTaughtLacksNothing) {
  const route::RouteKey key = test::KeyNumber(1);
  ASSERT_TRUE(
      store_.PutRoute(test::InfoOf(key, test::PiecesOf(key, 4), route::RouteState::kTeaching)));
  partial_.NoteDamaged(key, SegmentIndex(1));
  EXPECT_THAT(partial_.Look().value(), IsEmpty());
  EXPECT_EQ(partial_.routes(), 0U);
}

TEST_F(PartialRoutesTest, WhatIsStoredAgainIsNotLackingAnyMore) {
  Store(1, 3);
  Store(2, 4);
  const std::pair damaged{test::KeyNumber(2), SegmentIndex(0)};
  store_.damaged.insert(damaged);
  partial_.NoteDamaged(damaged.first, damaged.second);
  EXPECT_EQ(partial_.Look().value().size(), 2U);
  EXPECT_EQ(partial_.segments(), 2U);
  partial_.NoteStored(test::KeyNumber(1), SegmentIndex(3));
  EXPECT_EQ(partial_.routes(), 1U);
  store_.damaged.clear();  // by another server that has the same store
  Store(1, 4);
  EXPECT_THAT(partial_.Look().value(), IsEmpty());
  EXPECT_EQ(partial_.routes(), 0U);
}

TEST_F(PartialRoutesTest, ARouteThatIsDeletedIsForgotten) {
  Store(1, 2);
  EXPECT_EQ(partial_.Look().value().size(), 1U);
  route::RouteInfo gone = *store_.FindRoute(test::KeyNumber(1)).value();
  gone.standing = route::Standing::kDeleted;
  ++gone.edition;
  ASSERT_TRUE(store_.PutRoute(gone));
  EXPECT_THAT(partial_.Look().value(), IsEmpty());
  EXPECT_EQ(partial_.routes(), 0U);
}

}  // namespace
}  // namespace trailcast::catalog
