#include "services/catalog/retention.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/store/route_store.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::catalog {
namespace {

using route::RouteState;
using route::Standing;
using std::chrono::hours;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class RetentionTest : public testing::Test {
 protected:
  void Teach(unsigned number, std::uint32_t revision, RouteState state = RouteState::kComplete,
             Standing standing = Standing::kStaged) {
    const route::RouteKey key = test::KeyNumber(number, revision);
    route::RouteInfo info = test::InfoOf(key, test::PiecesOf(key, 1), state);
    info.name = fmt::format("route-{}", number);
    info.taught_unix_ms = 1'670'000'000'000;  // the clocks of all scouts say 2022
    info.standing = standing;
    ASSERT_TRUE(store_->PutRoute(info));
  }
  // One round through the store, carried out, when all in it is so old; "route/revision" of what
  // went.
  std::vector<std::string> Go(const RetentionPolicy& policy, int pages = 1, int days_old = 0) {
    Retention retention(*store_, policy);
    std::vector<std::string> gone;
    for (; pages > 0; --pages) {
      const auto outdated = retention
                                .Next([&](const std::vector<Retention::Grown>& revisions)
                                          -> Result<std::vector<std::chrono::milliseconds>> {
                                  return std::vector<std::chrono::milliseconds>(
                                      revisions.size(), hours(24 * days_old));
                                })
                                .value();
      EXPECT_TRUE(store_->PutRoutes(outdated));
      for (const route::RouteInfo& info : outdated) {
        EXPECT_EQ(store_->FindRoute(info.key).value()->standing, Standing::kDeleted);
        gone.push_back(fmt::format("{}/{}", info.name, info.key.teaching.value()));
      }
    }
    return gone;
  }

  test::TempDir dir_;
  std::unique_ptr<store::RouteStore> store_ = store::OpenSqliteStore(dir_ / "routes.db").value();
};

TEST_F(RetentionTest, OfARouteTheActiveAndTheNewestOthersStay) {
  Teach(1, 1, RouteState::kComplete, Standing::kActive);
  for (const std::uint32_t revision : {2U, 3U, 4U}) Teach(1, revision);
  Teach(1, 5, RouteState::kTeaching);
  Teach(2, 1);
  EXPECT_THAT(Go({.keep_revisions = 3}), IsEmpty());
  EXPECT_THAT(Go({.keep_revisions = 1}), ElementsAre("route-1/3", "route-1/2"));
  EXPECT_THAT(Go({.keep_revisions = 1}), IsEmpty());
}

TEST_F(RetentionTest, OfWhatWasNotStoredLatelyTheActiveStaysWhateverScoutsClocksSaid) {
  Teach(1, 1, RouteState::kComplete, Standing::kActive);
  Teach(1, 2);
  Teach(1, 3, RouteState::kTeaching);
  Teach(2, 1, RouteState::kComplete, Standing::kRetired);
  const RetentionPolicy month{.keep_for = hours(24 * 30)};
  EXPECT_THAT(Go(month, 1, 29), IsEmpty());
  EXPECT_THAT(Go(month, 1, 31), UnorderedElementsAre("route-1/2", "route-1/3", "route-2/1"));
}

TEST_F(RetentionTest, ComesToEveryRouteAndRoundAgain) {
  for (unsigned number = 100; number < 350; ++number) {
    Teach(number, 1);
    Teach(number, 2);
  }
  EXPECT_EQ(Go({.keep_revisions = 1}, 8).size(), 250U);
  EXPECT_THAT(Go({.keep_revisions = 1}, 8), IsEmpty());
}

}  // namespace
}  // namespace trailcast::catalog
