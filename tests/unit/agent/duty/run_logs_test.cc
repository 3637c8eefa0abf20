#include "agent/duty/run_logs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class RunLogsTest : public testing::Test {
 protected:
  // So many seconds ago.
  void Write(const std::string& name, std::size_t bytes, int ago_s) {
    std::ofstream(folder_ / name) << std::string(bytes, '.');
    fs::last_write_time(folder_ / name,
                        fs::file_time_type::clock::now() - std::chrono::seconds(ago_s));
  }
  [[nodiscard]] std::set<std::string> Files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  test::TempDir folder_;
  RunLogsOptions options_{.folder = folder_.path(), .most_bytes = 4000};
};

TEST_F(RunLogsTest, TheOldestMakeRoomAndOtherFilesStay) {
  Write("m1-1-1.mcap", 1500, 30);
  Write("m1-1-2-3.mcap", 1500, 20);
  Write("m2-1-1.mcap", 1400, 10);
  Write("notes.mcap", 9000, 60);
  Write("m0-1-2.log", 9000, 60);
  fs::create_symlink("notes.mcap", folder_ / "m0-1-1.mcap");
  const auto log = LogFor(options_, {.mission = "m3", .task = 0, .lap = 1});
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->log, folder_ / "m3-1-2.mcap");
  EXPECT_EQ(log->most_log_bytes, 1000U);
  EXPECT_EQ(log->header.Find("mission"), "m3");
  EXPECT_TRUE(log->header.Number("began_unix_ms"));
  EXPECT_THAT(Files(), ElementsAre("m0-1-1.mcap", "m0-1-2.log", "m1-1-2-3.mcap", "m2-1-1.mcap",
                                   "notes.mcap"));
}

TEST_F(RunLogsTest, ARunThatGoesOnHasALogOfItsOwn) {
  Write("m1-1-1.mcap", 10, 3);
  EXPECT_EQ(LogFor(options_, {.mission = "m1"})->log, folder_ / "m1-1-1-2.mcap");
}

TEST_F(RunLogsTest, ALogWithoutPicturesIsOneAllTheSame) {
  options_.picture_every_s = 0.0;
  const auto log = LogFor(options_, {.mission = "m1"});
  EXPECT_EQ(log->log, folder_ / "m1-1-1.mcap");
  EXPECT_EQ(log->picture_every_s, 0.0);
}

TEST_F(RunLogsTest, TheFolderIsMadeAndOneThatCannotBeIsNamed) {
  options_.folder = folder_ / "new";
  EXPECT_TRUE(LogFor(options_, {.mission = "m1"}));
  EXPECT_TRUE(fs::is_directory(folder_ / "new"));
  Write("file", 1, 0);
  options_.folder = folder_ / "file";
  const auto log = LogFor(options_, {.mission = "m1"});
  ASSERT_FALSE(log);
  EXPECT_THAT(log.error().message, HasSubstr("no log of this run is kept"));
}

}  // namespace
}  // namespace trailcast::agent
