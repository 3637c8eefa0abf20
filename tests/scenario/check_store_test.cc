// What an operator does with a store that was damaged.

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

class CheckStoreTest : public ProgramsTest {
 protected:
  Ended Check(const Words& more = {}) {
    return End(
        *Start("trailcast-server", With({"check", "--store", Path("scout.db")}, more), "check"));
  }
};

TEST_F(CheckStoreTest, AStoreCutShortIsFoundRepairedAndWholeThen) {
  // Long enough that its last pages hold segments alone.
  ASSERT_EQ(RunAgent(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db")).status, 0);
  const auto whole = Check();
  EXPECT_EQ(whole.status, 0);
  EXPECT_THAT(whole.output, HasSubstr("is whole"));

  const auto size = std::filesystem::file_size(Path("scout.db"));
  std::filesystem::resize_file(Path("scout.db"), size - 6 * 4096);
  const auto damaged = Check();
  EXPECT_EQ(damaged.status, 1);
  EXPECT_THAT(damaged.output, HasSubstr("is cut short"));
  EXPECT_THAT(damaged.output, HasSubstr("check --repair"));

  const auto repaired = Check({"--repair"});
  EXPECT_EQ(repaired.status, 0) << repaired.output;
  EXPECT_THAT(repaired.output, HasSubstr("repaired: 1 route"));
  EXPECT_THAT(repaired.output, HasSubstr("lost: segment"));
  EXPECT_TRUE(std::filesystem::exists(Path("scout.db.damaged")));
  EXPECT_EQ(Check().status, 0);
}

TEST_F(CheckStoreTest, AServerOnADamagedStoreServesWhatIsWholeAndTakesNothing) {
  ASSERT_EQ(RunAgent(TeachWords(Walk("taught", 2 * kTaughtFrames), "scout.db")).status, 0);
  std::filesystem::copy(Path("scout.db"), Path("server.db"));
  std::filesystem::resize_file(Path("server.db"),
                               std::filesystem::file_size(Path("server.db")) - 6 * 4096);
  const auto server = Server();
  EXPECT_THAT(server->output(), HasSubstr("is cut short"));
  EXPECT_THAT(server->output(), HasSubstr("lost: segment"));
  EXPECT_THAT(server->output(), HasSubstr("read only"));
  const auto routes = End(*Start("trailcast", {"routes"}, "tool"));
  EXPECT_THAT(routes.output, HasSubstr("hall"));
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
