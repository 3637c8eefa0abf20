// A scout that is killed while it teaches, and started again, as a user does it.
#include <fstream>

#include "tests/scenario/programs.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class UnfinishedRun : public ProgramsTest {
 protected:
  UnfinishedRun() { std::ofstream(Path("path.csv")) << "x_m,y_m\n1,1.5\n6,1.5\n"; }
  [[nodiscard]] Words Teach(const Words& more) const {
    return With({"teach", "--sim", "indoor", "--path", Path("path.csv"), "--route", "hall",
                 "--store", Path("scout.db"), "--server"},
                more);
  }
  // At its first segment, with more to come.
  void TeachAndKill() {
    const auto scout = Agent(Teach({}), "killed");
    ASSERT_TRUE(scout->WaitForOutput("segment 0 of 'hall'")) << scout->output();
    scout->Signal(SIGKILL);
    EXPECT_TRUE(scout->Wait());
    ASSERT_THAT(Teachings(), HasSubstr("unfinished"));
  }
  std::string Teachings() { return RunAgent({"teachings", "--store", Path("scout.db")}).output; }
  std::string Tool(const Words& words) { return End(*Start("trailcast", words, "tool")).output; }
};

TEST_F(UnfinishedRun, GoesOnAndIsFollowed) {
  const auto server = Server();
  TeachAndKill();
  const auto on = RunAgent(Teach({"--unfinished", "go-on"}));
  ASSERT_EQ(on.status, 0) << on.output;
  EXPECT_THAT(on.output,
              AllOf(HasSubstr("teaching on"), HasSubstr("robots follow route 'hall' revision 1")));
  EXPECT_THAT(Tool({"routes"}), AllOf(HasSubstr("@1"), HasSubstr("active"), Not(HasSubstr("@2"))));
  const auto follower = RunAgent({"replay", "--sim", "indoor", "--path", Path("path.csv"),
                                  "--camera", "wide", "--seed", "7", "--name", "robot", "--route",
                                  "hall@1", "--store", Path("robot.db"), "--server"});
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("state=ARRIVED"));
}

TEST_F(UnfinishedRun, IsKeptAndTaughtAnewWhereNobodyIsAsked) {
  const auto server = Server();
  TeachAndKill();
  const auto anew = RunAgent(Teach({}));
  ASSERT_EQ(anew.status, 0) << anew.output;
  EXPECT_THAT(anew.output, AllOf(HasSubstr("was cut off"), HasSubstr("--unfinished go-on"),
                                 HasSubstr("robots follow route 'hall' revision 2")));
  EXPECT_THAT(Tool({"routes"}), AllOf(HasSubstr("cut off"), HasSubstr("active")));
}

TEST_F(UnfinishedRun, WhoWaitsForItIsToldThatItWasCutOff) {
  const auto server = Server();
  TeachAndKill();
  const auto delivered = RunAgent({"deliver", "--store", Path("scout.db")});
  ASSERT_EQ(delivered.status, 0) << delivered.output;
  const Words follow{"replay", "--sim",   "indoor", "--path",  Path("path.csv"), "--name",
                     "robot",  "--route", "hall",   "--store", Path("robot.db"), "--server"};
  const auto waited = RunAgent(With(follow, {"--wait-for-route", "--wait", "5"}));
  EXPECT_EQ(waited.status, 1) << waited.output;
  EXPECT_THAT(waited.output,
              AllOf(HasSubstr("waited 5 s in vain: server 'server' has no active revision of route "
                              "'hall'; it has "),
                    HasSubstr("@1 (cut off): its teaching was cut off, and robots follow no "
                              "revision of it; teach it again, or finish it")));
  EXPECT_THAT(Tool({"routes", "--name", "hall", "--state", "active"}),
              HasSubstr("'trailcast routes --name hall' lists it, if there is one"));
}

TEST_F(UnfinishedRun, IsOfferedToNobodyOnceItIsDiscarded) {
  const auto server = Server();
  TeachAndKill();
  const auto anew = RunAgent(Teach({"--unfinished", "discard"}));
  ASSERT_EQ(anew.status, 0) << anew.output;
  EXPECT_THAT(anew.output,
              AllOf(HasSubstr("is discarded"), HasSubstr("robots follow route 'hall' revision 2")));
  EXPECT_THAT(Teachings(), Not(HasSubstr("unfinished")));
  EXPECT_EQ(RunAgent(Teach({"--unfinished", "go-on"})).status, 1) << "not even asked for";
}

}  // namespace
}  // namespace trailcast::test
