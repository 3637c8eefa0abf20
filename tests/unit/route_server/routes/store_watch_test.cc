#include "route_server/routes/store_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"

namespace trailcast::server {
namespace {

using testing::HasSubstr;
using testing::Optional;

class AwayStore : public test::MemoryStore {
 public:
  bool away = false;
  int asked = 0;
  Result<void> CheckReachable() override {
    ++asked;
    if (away) return Fail(ErrorCode::kUnavailable, "db.site does not answer");
    return {};
  }
};

TEST(StoreWatch, TellsOnceThatTheStoreIsAwayAndOnceThatItIsBack) {
  AwayStore store;
  StoreWatch watch(store);
  StoreWatch::Time now{};
  EXPECT_EQ(watch.Look(now), std::nullopt);
  store.away = true;
  EXPECT_EQ(watch.Look(now), std::nullopt) << "not due yet";
  EXPECT_EQ(store.asked, 1);
  now += StoreWatch::kLookEvery;
  EXPECT_THAT(watch.Look(now), Optional(HasSubstr("is away")));
  EXPECT_EQ(watch.trouble(), "db.site does not answer");
  now += StoreWatch::kLookEveryAway;
  EXPECT_EQ(watch.Look(now), std::nullopt);
  EXPECT_EQ(store.asked, 3);
  store.away = false;
  now += StoreWatch::kLookEveryAway;
  EXPECT_THAT(watch.Look(now), Optional(HasSubstr("there again")));
  EXPECT_EQ(watch.trouble(), "");
}

}  // namespace
}  // namespace trailcast::server
