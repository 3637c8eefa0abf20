#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

constexpr int kRounds = 10;
constexpr std::uint32_t kEnough = 100000;

// The child: appends from `next` on, two pieces at a time, and says which are durable.
[[noreturn]] void AppendUntilKilled(const std::filesystem::path& file, std::uint32_t next,
                                    int report) {
  auto store = OpenSqliteStore(file);
  for (; store && next < kEnough; next += 2) {
    if (!(*store)->AppendSegments(Pieces({next, next + 1}))) break;
    const std::uint32_t durable = next + 2;
    if (write(report, &durable, sizeof(durable)) != sizeof(durable)) break;
  }
  _exit(1);  // not reached unless something failed
}

// Lets a child append, kills it after `reports` reports and some microseconds more, and returns how
// many segments it said were durable (at least).
std::uint32_t AppendAndKill(const std::filesystem::path& file, std::uint32_t next, int reports,
                            std::chrono::microseconds more) {
  int ends[2] = {};
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) AppendUntilKilled(file, next, ends[1]);
  close(ends[1]);
  std::uint32_t durable = 0;
  std::uint32_t reported = 0;
  for (int i = 0; i < reports && read(ends[0], &reported, sizeof(reported)) > 0; ++i) {
    durable = reported;
  }
  usleep(static_cast<useconds_t>(more.count()));  // the random moment within a commit
  kill(child, SIGKILL);
  while (read(ends[0], &reported, sizeof(reported)) > 0) durable = reported;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself: an append failed";
  return durable;
}

TEST(StoreCrash, EverySegmentSaidToBeDurableIsThereByteForByteAfterAKill) {
  test::TempDir dir;
  const std::filesystem::path file = dir / "routes.db";
  std::mt19937 random(20090401);
  std::uint32_t held_before = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto reports = static_cast<int>(random() % 12U);
    const std::uint32_t durable =
        AppendAndKill(file, held_before, reports, std::chrono::microseconds(random() % 3000U));
    auto store = OpenSqliteStore(file);
    ASSERT_TRUE(store) << store.error().message;  // the lock went with the process
    const auto held = (*store)->HeldSegments(kYard).value();
    ASSERT_GE(held.size(), durable);
    ASSERT_GE(held.size(), held_before);
    ASSERT_EQ(held.size() % 2, 0U) << "half a batch was kept";
    for (std::uint32_t i = 0; i < held.size(); ++i) {
      ASSERT_EQ((*store)->ReadSegment(kYard, SegmentIndex(i)).value(), Piece(i));
    }
    ASSERT_TRUE((*store)->Verify().value().empty());
    held_before = static_cast<std::uint32_t>(held.size());
  }
  EXPECT_GT(held_before, 20U) << "the children hardly got to work: nothing was tested";
}

}  // namespace
}  // namespace trailcast::store
