// Scout, server and follower as processes over DDS on the loopback interface.
#include "tests/scenario/programs.h"
#include "tests/support/places.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SharingTest : public ProgramsTest {};

TEST_F(SharingTest, AFollowerReplaysWhatAScoutTaught) {
  const auto server = Server();
  const auto scout =
      RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
  ASSERT_EQ(scout.status, 0) << scout.output;
  EXPECT_THAT(scout.output, HasSubstr("unreceipted=0"));
  const auto follower =
      RunAgent(With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"),
                    {"--server", "--csv", Path("out.csv"), "--report", Path("report.txt")}));
  EXPECT_EQ(follower.status, 0) << follower.output;
  EXPECT_THAT(follower.output, HasSubstr("state=ARRIVED"));
  EXPECT_TRUE(std::filesystem::exists(Path("out.csv")));
  EXPECT_TRUE(std::filesystem::exists(Path("report.txt")));
  server->Signal(SIGTERM);
  EXPECT_EQ(End(*server).status, 0);
}

TEST_F(SharingTest, AFollowerMayBeThereBeforeServerAndScout) {
  const auto follower = Agent(With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"),
                                   {"--server", "--wait-for-route"}),
                              "follower");
  ASSERT_TRUE(follower->WaitForOutput("asking for route 'hall'")) << follower->output();
  const auto server = Server();
  const auto scout =
      RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
  EXPECT_EQ(scout.status, 0) << scout.output;
  EXPECT_EQ(End(*follower).status, 0) << follower->output();
}

TEST_F(SharingTest, AScoutDeliversToAServerThatComesLate) {
  const auto scout =
      Agent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}), "scout");
  ASSERT_TRUE(scout->WaitForOutput("waiting for a server's acknowledgement")) << scout->output();
  const auto server = Server();
  EXPECT_EQ(End(*scout).status, 0) << scout->output();
}

TEST_F(SharingTest, AScoutWithoutAServerKeepsTheRouteAndDeliversItAnotherTime) {
  const auto alone = RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"),
                                   {"--server", "--delivery-timeout", "0.5"}));
  EXPECT_EQ(alone.status, 1);
  EXPECT_THAT(alone.output, HasSubstr("segments not acknowledged, kept in " + Path("scout.db")));
  const auto server = Server();
  const auto again = RunAgent({"deliver", "--store", Path("scout.db")});
  EXPECT_EQ(again.status, 0) << again.output;
  const auto follower =
      RunAgent(With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"), {"--server"}));
  EXPECT_EQ(follower.status, 0) << follower.output;
}

TEST_F(SharingTest, AServerThatWasKilledStillHasWhatItConfirmed) {
  auto server = Server();
  const auto scout =
      RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
  ASSERT_EQ(scout.status, 0) << scout.output;
  server->Signal(SIGKILL);
  EXPECT_EQ(End(*server).status, 128 + SIGKILL);
  server = Server("server.db", "server2");
  const auto follower =
      RunAgent(With(ReplayWords(Walk("seen", kFollowerFrames), "follower.db"), {"--server"}));
  EXPECT_EQ(follower.status, 0) << follower.output;
}

TEST_F(SharingTest, ARouteNobodyTaughtIsNamedWithThoseThereAre) {
  const auto server = Server();
  ASSERT_EQ(
      RunAgent(With(TeachWords(Walk("walk", kTaughtFrames), "scout.db"), {"--server"})).status, 0);
  const auto run = RunAgent({"replay", "--frames", Path("walk"), "--route", "hell", "--store",
                             Path("follower.db"), "--server"});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("no route 'hell'"), HasSubstr("hall")));
}

TEST_F(SharingTest, AFollowerThatNoServerAnswersSaysSo) {
  const auto run =
      RunAgent(With(ReplayWords(Walk("walk", 2), "follower.db"), {"--server", "--wait", "0.5"}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("no server answered"));
}

TEST_F(SharingTest, TheExampleConfigurationsAreAccepted) {
  const std::string config = SourceDir() + "/config/";
  const auto agent =
      RunAgent({"--config", config + "agent/agent.toml", "--store", Path("a.db"), "replay",
                "--camera", config + "agent/camera.toml", "--wait", "0.1"});
  EXPECT_EQ(agent.status, 1);
  EXPECT_THAT(agent.output, HasSubstr("no server answered"));
  const auto server = Start(
      "trailcast-server",
      {"--config", config + "route_server/server.toml", "--store", Path("server.db")}, "server");
  ASSERT_TRUE(server->WaitForOutput("ready")) << server->output();
  server->Signal(SIGINT);
  EXPECT_EQ(End(*server).status, 0);
}

TEST_F(SharingTest, LogsAreObjectsForProgramsOnRequest) {
  const auto server =
      Start("trailcast-server", {"--store", Path("server.db"), "--log-format", "json"}, "server");
  ASSERT_TRUE(server->WaitForOutput("ready")) << server->output();
  server->Signal(SIGTERM);
  EXPECT_EQ(End(*server).status, 0);
  EXPECT_THAT(server->output(),
              testing::ContainsRegex("[{]\"time\":\"20[0-9-]+T[0-9:.]+Z\",\"level\":\"info\","
                                     "\"name\":\"server\",\"text\":\"ready: 0 routes in the "
                                     "store\"[}]\n"));
}

TEST_F(SharingTest, ASecondProcessOfANameIsRefused) {
  const auto walk = Walk("walk", 2);
  const Words robot{"--server", "--name", "robot", "--discovery", "mesh"};
  const auto first = Agent(With(ReplayWords(walk, "a.db"), robot), "first");
  ASSERT_TRUE(first->WaitForOutput("asking for route")) << first->output();
  const auto second = RunAgent(With(ReplayWords(walk, "b.db"), robot));
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.output, AllOf(HasSubstr("agent name 'robot' is already used"),
                                   HasSubstr("choose another with --name")));
  EXPECT_FALSE(first->Ended()) << first->output();

  const auto server = Server();
  const auto other = Start("trailcast-server", {"--store", Path("other.db")}, "other");
  EXPECT_EQ(End(*other).status, 1);
  EXPECT_THAT(other->output(), HasSubstr("name 'server' is already used"));
}

TEST_F(SharingTest, AServerTellsWhoseANameIs) {
  const auto server = Server();
  const auto walk = Walk("walk", 2);
  const Words robot{"--server", "--wait-for-route", "--name", "robot", "--discovery", "star"};
  const auto first = Agent(With(ReplayWords(walk, "a.db"), robot), "first");
  ASSERT_TRUE(server->WaitForOutput("'robot' asks")) << first->output();
  const auto second = RunAgent(With(ReplayWords(walk, "b.db"), robot));
  EXPECT_EQ(second.status, 1);
  EXPECT_THAT(second.output, HasSubstr("agent name 'robot' is already used"));
  EXPECT_FALSE(first->Ended()) << first->output();
}

TEST_F(SharingTest, ANameThatTwoHaveIsToldWhenItIsNoticed) {
  const auto walk = Walk("walk", 2);
  const Words robot{"--server", "--wait-for-route", "--name", "robot", "--discovery", "star"};
  const auto first = Agent(With(ReplayWords(walk, "a.db"), robot), "first");
  const auto second = Agent(With(ReplayWords(walk, "b.db"), robot), "second");
  ASSERT_TRUE(first->WaitForOutput("asking for route")) << first->output();
  ASSERT_TRUE(second->WaitForOutput("asking for route")) << second->output();
  const auto server = Server();
  EXPECT_TRUE(server->WaitForOutput("two processes are called 'robot'")) << server->output();
  for (Process* each : {first.get(), second.get()}) {
    EXPECT_TRUE(each->WaitForOutput("another running process is called 'robot'")) << each->output();
  }
}

TEST_F(SharingTest, AnInterruptedScoutKeepsWhatItTaught) {
  const auto scout = Agent({"teach", "--sim", "indoor", "--camera", kSmallPictures, "--route",
                            "hall", "--store", Path("scout.db")},
                           "scout");
  ASSERT_TRUE(scout->WaitForOutput("segment 0 of 'hall'")) << scout->output();
  scout->Signal(SIGHUP);
  const auto ended = End(*scout);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("segments="));
  const auto other = RunAgent(
      {"replay", "--frames", Walk("walk", 2), "--route", "hell", "--store", Path("scout.db")});
  EXPECT_THAT(other.output, HasSubstr("did you mean 'hall'?"));
}

TEST_F(SharingTest, AnInterruptedFollowerEndsSoonAndSaysSo) {
  const auto follower = Agent(With(ReplayWords(Walk("walk", 2), "a.db"), {"--server"}), "follower");
  ASSERT_TRUE(follower->WaitForOutput("asking for route")) << follower->output();
  follower->Signal(SIGTERM);
  const auto ended = End(*follower);
  EXPECT_EQ(ended.status, 3) << ended.output;
  EXPECT_THAT(ended.output, HasSubstr("state=STOPPED"));
}

}  // namespace
}  // namespace trailcast::test
