// These test what an operator does with a store that was damaged.

#include <signal.h>
#include <sqlite3.h>

#include <fstream>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kPage = 4096;
constexpr int kIncomplete = 4;  // exit status: sound, but something is lost

class CheckStoreTest : public ProgramsTest {
 protected:
  void OverwriteRootOf(const std::string& table) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(Path("scout.db").c_str(), &db), SQLITE_OK);
    long root = 0;
    const auto note = [](void* into, int, char** values, char**) {
      *static_cast<long*>(into) = std::stol(values[0]);
      return 0;
    };
    const std::string sql = "SELECT rootpage FROM sqlite_schema WHERE name = '" + table + "'";
    ASSERT_EQ(sqlite3_exec(db, sql.c_str(), note, &root, nullptr), SQLITE_OK);
    sqlite3_close(db);
    Overwrite("scout.db", static_cast<std::size_t>(root - 1));
  }
  // Sixty-four bytes at a page's beginning, as when a sector of the disk is lost.
  void Overwrite(const std::string& store, std::size_t page) const {
    std::fstream file(Path(store), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(page * kPage)).write(std::string(64, 'Z').data(), 64);
  }
  Ended Check(const Words& more = {}, const std::string& store = "scout.db") {
    return End(*Start("trailcast-server", With({"check", "--store", Path(store)}, more), "check"));
  }
  std::string Routes() { return End(*Start("trailcast", {"routes"}, "tool")).output; }
};

TEST_F(CheckStoreTest, OfAStoreCutShortWhatIsWholeIsSavedAndWhatIsLostIsSaid) {
  // Long enough that its last pages hold segments alone.
  ASSERT_EQ(RunAgent(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db")).status, 0);
  const auto whole = Check();
  EXPECT_EQ(whole.status, 0);
  EXPECT_THAT(whole.output, HasSubstr("is whole"));

  const auto size = std::filesystem::file_size(Path("scout.db"));
  std::filesystem::resize_file(Path("scout.db"), size - 6 * kPage);
  const auto damaged = Check();
  EXPECT_EQ(damaged.status, 1);
  EXPECT_THAT(damaged.output, HasSubstr("is cut short"));
  EXPECT_THAT(damaged.output, HasSubstr("check --repair"));

  const auto repaired = Check({"--repair"});
  EXPECT_EQ(repaired.status, kIncomplete) << repaired.output;
  EXPECT_THAT(repaired.output, HasSubstr("repaired: 1 route"));
  EXPECT_THAT(repaired.output, HasSubstr("lost: segment"));
  EXPECT_TRUE(std::filesystem::exists(Path("scout.db.damaged")));
  const auto after = Check();
  EXPECT_EQ(after.status, kIncomplete);
  EXPECT_THAT(after.output, HasSubstr("lost: segment"));
  EXPECT_THAT(after.output, HasSubstr("is sound, but not all that it held is there"));
}

TEST_F(CheckStoreTest, WithoutTheRootOfATableNoSegmentIsLost) {
  ASSERT_EQ(RunAgent(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db")).status, 0);
  OverwriteRootOf("segment");
  EXPECT_EQ(Check().status, 1);
  const auto repaired = Check({"--repair"});
  EXPECT_EQ(repaired.status, kIncomplete) << repaired.output;
  EXPECT_THAT(repaired.output, HasSubstr("lost: perhaps more: 1 of the file's"));
  EXPECT_THAT(repaired.output, Not(HasSubstr("lost: segment")));
  EXPECT_EQ(Check().status, 0);
}

TEST_F(CheckStoreTest, WhatARepairLostTheServerFetchesFromTheScoutsStore) {
  {
    const auto server = Server("server.db");
    const auto scout =
        RunAgent(With(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db"), {"--server"}));
    ASSERT_EQ(scout.status, 0) << scout.output;
    server->Signal(SIGINT);
    ASSERT_EQ(End(*server).status, 0);
  }
  const auto pages = std::filesystem::file_size(Path("server.db")) / kPage;
  ASSERT_GT(pages, 25U);  // the last ones have segments
  for (std::size_t page = pages - 7; page < pages; page += 2) Overwrite("server.db", page);
  EXPECT_EQ(Check({}, "server.db").status, 1);
  const auto repaired = Check({"--repair"}, "server.db");
  EXPECT_EQ(repaired.status, kIncomplete);
  EXPECT_THAT(repaired.output, HasSubstr("lost: segment"));
  {
    const auto server = Server("server.db");
    EXPECT_TRUE(server->WaitForOutput("is served in part: segment")) << server->output();
    EXPECT_THAT(Routes(), HasSubstr("served in part: "));
    const auto scout = RunAgent({"deliver", "--store", Path("scout.db")});
    EXPECT_EQ(scout.status, 0) << scout.output << server->output();
    EXPECT_THAT(Routes(), Not(HasSubstr("served in part")));
    server->Signal(SIGINT);
    EXPECT_EQ(End(*server).status, 0);
  }
  const auto after = Check({}, "server.db");
  EXPECT_EQ(after.status, 0) << after.output;
}

TEST_F(CheckStoreTest, AServerOnADamagedStoreServesWhatIsWholeAndTakesNothing) {
  ASSERT_EQ(RunAgent(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db")).status, 0);
  std::filesystem::copy(Path("scout.db"), Path("server.db"));
  std::filesystem::resize_file(Path("server.db"),
                               std::filesystem::file_size(Path("server.db")) - 6 * kPage);
  const auto server = Server();
  EXPECT_THAT(server->output(), HasSubstr("is cut short"));
  EXPECT_THAT(server->output(), HasSubstr("lost: segment"));
  EXPECT_THAT(server->output(), HasSubstr("read only"));
  EXPECT_THAT(Routes(), HasSubstr("hall"));
  const auto retire = End(*Start("trailcast", {"routes", "retire", "hall"}, "tool"));
  EXPECT_EQ(retire.status, 1);
  EXPECT_THAT(retire.output, HasSubstr("read only until it is repaired"));
  const auto scout = Agent(With(TeachWords(Path("taught"), "other.db"), {"--server"}), "scout");
  EXPECT_TRUE(scout->WaitForOutput("read only until it is repaired")) << scout->output();
}

TEST_F(CheckStoreTest, AStoreInUseOrNotThereIsNotTouched) {
  EXPECT_THAT(Check().output, HasSubstr("there is no route store"));
  const auto server = Server("scout.db");
  const auto in_use = Check({"--repair"});
  EXPECT_EQ(in_use.status, 1);
  EXPECT_THAT(in_use.output, HasSubstr("is open in another process"));
}

}  // namespace
}  // namespace trailcast::test
