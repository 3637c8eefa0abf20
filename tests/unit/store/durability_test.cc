// These test what waits for the disk. SQLite's calls for that come by here, and are counted.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace {
int g_waits = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
}  // namespace

extern "C" int fdatasync(int descriptor) {
  ++g_waits;
  return static_cast<int>(syscall(SYS_fdatasync, descriptor));
}
extern "C" int fsync(int descriptor) {
  ++g_waits;
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

namespace trailcast::store {
namespace {

template <typename Work>
int WaitsIn(const Work& work) {
  const int before = g_waits;
  EXPECT_TRUE(work());
  return g_waits - before;
}

TEST(Durability, WhatIsAppendedIsOnTheDiskAtOnce) {
  const test::TempDir folder;
  const auto store = OpenSqliteStore(folder / "routes.db").value();
  EXPECT_GT(WaitsIn([&] { return store->AppendSegments(Pieces({0})); }), 0);
  EXPECT_GT(WaitsIn([&] { return store->AppendFetched(Pieces({1})); }), 0);
  EXPECT_GT(WaitsIn([&] { return store->PutRoute(Teaching(2)); }), 0);
}

TEST(Durability, OfCopiesItIsWithTheRouteThatCountsThem) {
  const test::TempDir folder;
  const SqliteOptions options{.durability = SqliteOptions::Durability::kWithRoutes};
  const auto store = OpenSqliteStore(folder / "routes.db", options).value();
  ASSERT_TRUE(store->AppendFetched(Pieces({0})));  // begins the log, whose header is waited for
  EXPECT_EQ(WaitsIn([&] { return store->AppendFetched(Pieces({1})); }), 0);
  EXPECT_EQ(WaitsIn([&] { return store->AppendFetched(Pieces({2})); }), 0);
  EXPECT_GT(WaitsIn([&] { return store->PutRoute(Complete(3)); }), 0);
  EXPECT_EQ(WaitsIn([&] { return store->AppendFetched(Pieces({3})); }), 0);
}

}  // namespace
}  // namespace trailcast::store
