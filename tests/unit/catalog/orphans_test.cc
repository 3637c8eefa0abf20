#include "services/catalog/orphans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"

namespace trailcast::catalog {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using testing::ElementsAre;
using testing::IsEmpty;

class OrphansTest : public testing::Test {
 protected:
  static constexpr Orphans::Time kStart{};
  void Store(unsigned number, std::uint32_t segments) {
    ASSERT_TRUE(store_.AppendSegments(test::PiecesOf(test::KeyNumber(number), segments)));
  }
  void Announce(unsigned number) {
    const route::RouteKey key = test::KeyNumber(number);
    ASSERT_TRUE(
        store_.PutRoute(test::InfoOf(key, test::PiecesOf(key, 1), route::RouteState::kTeaching)));
  }
  // A round through the store.
  std::vector<route::RouteKey> Old(Orphans::Time now) {
    std::vector<route::RouteKey> old;
    for (int page = 0; page < 4; ++page) {
      const auto next = orphans_.Next(now).value();
      for (const store::HeldTeaching& each : next) old.push_back(each.key);
    }
    return old;
  }

  test::MemoryStore store_;
  Orphans orphans_{store_};
};

TEST_F(OrphansTest, WhatNobodyAnnouncedForADayIsOld) {
  Store(1, 2);
  Store(2, 1);
  Announce(2);
  EXPECT_THAT(Old(kStart), IsEmpty());
  EXPECT_THAT(Old(kStart + hours(23)), IsEmpty());
  const auto old = orphans_.Next(kStart + hours(24)).value();
  ASSERT_EQ(old.size(), 1U);
  EXPECT_EQ(old[0].key, test::KeyNumber(1));
  EXPECT_EQ(old[0].segments, 2U);
}

TEST_F(OrphansTest, WhatGrowsOrIsAnnouncedMeanwhileIsNot) {
  Store(1, 1);
  Store(2, 1);
  EXPECT_THAT(Old(kStart), IsEmpty());
  Store(1, 2);
  Announce(2);
  EXPECT_THAT(Old(kStart + hours(20)), IsEmpty());
  EXPECT_THAT(Old(kStart + hours(25)), IsEmpty());
  ASSERT_TRUE(store_.DropSegments(test::KeyNumber(1)));
  EXPECT_THAT(Old(kStart + hours(26)), IsEmpty());
  Store(1, 2);
  EXPECT_THAT(Old(kStart + hours(27)), IsEmpty());
  EXPECT_THAT(Old(kStart + hours(50)), IsEmpty()) << "it was gone in between";
}

TEST_F(OrphansTest, ComesToEveryTeaching) {
  for (unsigned number = 0; number < 250; ++number) Store(number, 1);
  EXPECT_THAT(Old(kStart), IsEmpty());
  EXPECT_EQ(Old(kStart + hours(24) + minutes(1)).size(), 250U);
}

}  // namespace
}  // namespace trailcast::catalog
