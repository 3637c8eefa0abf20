#include "services/store/store_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

using testing::HasSubstr;

TEST(StoreLock, SecondOpeningInTheSameProcessIsAConflictUntilTheFirstIsClosed) {
  test::TempDir dir;
  auto first = OpenSqliteStore(dir / "routes.db");
  ASSERT_TRUE(first);
  const auto second = OpenSqliteStore(dir / "routes.db");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kConflict);
  EXPECT_THAT(second.error().message, HasSubstr("is open in another process; stop that one"));
  first->reset();
  EXPECT_TRUE(OpenSqliteStore(dir / "routes.db"));
}

TEST(StoreLock, OtherProcessHoldsItUntilItDiesHoweverItDies) {
  test::TempDir dir;
  int ready[2] = {};
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto store = OpenSqliteStore(dir / "routes.db");
    if (write(ready[1], store ? "y" : "n", 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  close(ready[1]);
  char answer = 0;
  ASSERT_EQ(read(ready[0], &answer, 1), 1);
  close(ready[0]);
  EXPECT_EQ(answer, 'y');
  const auto meanwhile = OpenSqliteStore(dir / "routes.db");
  EXPECT_TRUE(!meanwhile && meanwhile.error().code == ErrorCode::kConflict);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(OpenSqliteStore(dir / "routes.db"));
}

TEST(StoreLock, LeavesNothingBesideTheStoreWhenClosed) {
  test::TempDir dir;
  ASSERT_TRUE(OpenSqliteStore(dir / "routes.db"));
  for (const auto& entry : std::filesystem::directory_iterator(dir.path())) {
    EXPECT_EQ(entry.path().filename(), "routes.db");
  }
}

}  // namespace
}  // namespace trailcast::store
