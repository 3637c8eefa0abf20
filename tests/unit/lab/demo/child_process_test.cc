#include "services/lab/demo/child_process.h"

#include <gmock/gmock.h>
#include <sys/types.h>

#include <csignal>

#include "tests/support/await.h"
#include "tests/support/temp_dir.h"

namespace trailcast::demo {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Ended, though perhaps not yet collected by a parent that takes its time.
bool HasEnded(pid_t pid) {
  if (kill(pid, 0) != 0) return true;
  const std::vector<std::string> stat = LastLines(fmt::format("/proc/{}/stat", pid), 1);
  return stat.empty() || stat.front().find(") Z ") != std::string::npos;
}

class ChildProcessTest : public ::testing::Test {
 protected:
  ChildProcess Shell(const std::string& script) {
    auto started = ChildProcess::Start({"/bin/sh", "-c", script}, log());
    EXPECT_TRUE(started.has_value());
    return std::move(*started);
  }
  // The number that the script printed as its first line.
  pid_t PrintedPid() {
    std::vector<std::string> lines;
    EXPECT_TRUE(test::WaitUntil([&] { return !(lines = LastLines(log(), 1)).empty(); }));
    return lines.empty() ? -1 : std::stoi(lines.front());
  }
  [[nodiscard]] std::filesystem::path log() const { return folder_ / "log.txt"; }

 private:
  test::TempDir folder_;
};

TEST_F(ChildProcessTest, TellsHowItEndedAndKeepsWhatItPrinted) {
  ChildProcess child = Shell("echo one; echo two >&2; echo three; exit 3");
  ASSERT_TRUE(test::WaitUntil([&] { return child.Poll().has_value(); }));
  EXPECT_EQ(child.Poll()->code, 3);
  EXPECT_FALSE(child.Poll()->ok());
  EXPECT_THAT(LastLines(log(), 2), ElementsAre("two", "three"));
}

TEST_F(ChildProcessTest, EndsWhenAskedTo) {
  ChildProcess child = Shell("trap 'exit 7' TERM; echo $$; while :; do sleep 0.05; done");
  PrintedPid();
  EXPECT_FALSE(child.Poll().has_value());
  child.Terminate();
  child.Reap(test::kLongEnough);
  EXPECT_EQ(child.Poll()->code, 7);
}

TEST_F(ChildProcessTest, IsKilledWithItsOwnChildrenWhenItDoesNotListen) {
  ChildProcess child = Shell("trap '' TERM; sleep 1000 & echo $!; while :; do wait; done");
  const pid_t grandchild = PrintedPid();
  child.Terminate();
  child.Reap(milliseconds(50));
  EXPECT_EQ(child.Poll()->signal, SIGKILL);
  EXPECT_TRUE(test::WaitUntil([&] { return HasEnded(grandchild); }));
}

TEST_F(ChildProcessTest, IsGoneWhenItsObjectGoes) {
  pid_t pid = -1;
  {
    const ChildProcess child = Shell("echo $$; exec sleep 1000");
    pid = PrintedPid();
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_NE(kill(pid, 0), 0);
}

TEST_F(ChildProcessTest, AProgramThatIsNotThereIsNamed) {
  const auto refused = ChildProcess::Start({"/nonexistent/trailcast-agent"}, log());
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("/nonexistent/trailcast-agent"));
}

TEST_F(ChildProcessTest, ALogThatIsNotThereHasNoLastLines) {
  EXPECT_THAT(LastLines(log(), 5), IsEmpty());
}

}  // namespace
}  // namespace trailcast::demo
