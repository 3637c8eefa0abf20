#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "agent/tool/fleet_view.h"
#include "agent/tool/live_lines.h"
#include "agent/tool/work_folder.h"
#include "tests/support/temp_dir.h"

namespace trailcast::tool {
namespace {

using ::testing::HasSubstr;

TEST(ProgressBar, FillsFromTheLeftAndStaysWithinItsWidth) {
  EXPECT_EQ(ProgressBar(0.0, 4), "[    ]");
  EXPECT_EQ(ProgressBar(0.5, 4), "[=>  ]");
  EXPECT_EQ(ProgressBar(1.0, 4), "[====]");
  EXPECT_EQ(ProgressBar(7.0, 4), "[====]");
  EXPECT_EQ(ProgressBar(std::nan(""), 4), "[    ]");
}

// What LiveLines writes to a file, which is no terminal.
TEST(LiveLines, OffATerminalALineIsNotRepeatedBeforeItsTimeButForTheLast) {
  const test::TempDir folder;
  const std::filesystem::path file = folder / "out.txt";
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "w"),
                                                              &std::fclose);
    LiveLines live(out.get(), std::chrono::hours(1));
    live.Show({"first"});
    live.Show({"too soon"});
    live.Show({"last"}, true);
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "r"),
                                                           &std::fclose);
  char text[64] = {};
  const std::size_t count = std::fread(text, 1, sizeof text - 1, in.get());
  EXPECT_EQ(std::string(text, count), "first\nlast\n");
}

exchange::AgentStatus Status(const std::string& agent, exchange::AgentMode mode, double progress) {
  exchange::AgentStatus status;
  status.agent = AgentId(agent);
  status.role = exchange::AgentRole::kFollower;
  status.mode = mode;
  status.progress = progress;
  return status;
}

TEST(FleetView, KeepsTheLatestStatusEvenOfAnAgentThatHasGone) {
  FleetView view;
  EXPECT_EQ(view.Find(AgentId("one")), nullptr);
  view.Handle(Status("one", exchange::AgentMode::kReplaying, 0.3));
  view.Handle(Status("two", exchange::AgentMode::kReplaying, 0.1));
  view.Handle(Status("one", exchange::AgentMode::kArrived, 1.0));
  view.Handle(exchange::AgentGone{AgentId("one"), 0});
  ASSERT_NE(view.Find(AgentId("one")), nullptr);
  EXPECT_EQ(view.Find(AgentId("one"))->mode, exchange::AgentMode::kArrived);
}

TEST(StatusLine, TellsWhatAFollowerDoes) {
  exchange::AgentStatus status = Status("one", exchange::AgentMode::kReplaying, 0.25);
  status.segment = 2;
  status.segments = 9;
  status.features = 41;
  const std::string line = StatusLine("one", "wide", &status);
  EXPECT_THAT(line, HasSubstr("following"));
  EXPECT_THAT(line, HasSubstr("segment  3 of  9, 41 features"));
  EXPECT_THAT(line, HasSubstr(" 25 %"));
}

TEST(StatusLine, ShowsWhatAnAgentSaysOfItsFault) {
  exchange::AgentStatus status = Status("one", exchange::AgentMode::kFault, 0.5);
  status.detail = "lost at segment 4";
  EXPECT_THAT(StatusLine("one", "wide", &status), HasSubstr("FAULT     lost at segment 4"));
  EXPECT_THAT(StatusLine("one", "wide", nullptr), HasSubstr("not heard of yet"));
}

TEST(WorkFolder, GoesWithAllThatIsInItUnlessItIsToBeKept) {
  std::filesystem::path gone;
  std::filesystem::path kept;
  {
    auto first = WorkFolder::Make();
    auto second = WorkFolder::Make();
    ASSERT_TRUE(first.has_value() && second.has_value());
    gone = first->path();
    kept = second->path();
    EXPECT_NE(gone, kept);
    std::filesystem::create_directories(*first / "deep/er");
    const WorkFolder moved = std::move(*first);
    second->Keep();
    EXPECT_TRUE(std::filesystem::exists(gone));
  }
  EXPECT_FALSE(std::filesystem::exists(gone));
  EXPECT_TRUE(std::filesystem::exists(kept));
  std::filesystem::remove_all(kept);
}

}  // namespace
}  // namespace trailcast::tool
