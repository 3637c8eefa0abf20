// These test what operators send robots to do, and what becomes of it.
#include <chrono>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class MissionsTest : public RobotsTest {
 protected:
  void SetUp() override {
    Teach();
    server_ = Server();
  }
  // Starts a robot at the route's beginning, and its agent, which waits to be sent.
  void GoOnDuty() {
    robot_ = Robot("robot1", {"--sim-truth", Path("truth.csv")});
    agent_ = Serve("robot1");
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }
  Ended Send(const Words& orders) { return Tool(With({"send", "robot1"}, orders)); }
  Ended Missions(const Words& words = {}) { return Tool(With({"missions"}, words)); }

  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> agent_;
  int tools_ = 0;
};

TEST_F(MissionsTest, ARobotOnDutyFollowsWhatItIsSentAlong) {
  most_mps_ = kUnwatched_mps;
  GoOnDuty();
  const Ended sent = Send({"follow", "hall", "..2", "wait", "0.5", "--id", "first", "--wait"});
  EXPECT_EQ(sent.status, 0) << sent.output << agent_->output();
  EXPECT_THAT(sent.output, AllOf(HasSubstr("mission first"), HasSubstr("robot1: under way"),
                                 HasSubstr("robot1: arrived")));
  EXPECT_NEAR(Along_m("truth.csv"), 3.0, 0.25) << "two metres from where it began";
  const Ended again = Send({"follow", "hall", "..2", "wait", "0.5", "--id", "first"});
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("robot1: arrived")) << "it is done once";
  const Ended nothing = Tool({"cancel", "robot1"});
  EXPECT_EQ(nothing.status, 1) << nothing.output;
  EXPECT_THAT(nothing.output, HasSubstr("has no mission to cancel"));
  const Ended rest = Send({"follow", "hall", "2..", "--wait"});
  EXPECT_EQ(rest.status, 0) << rest.output << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.5, 0.25);
  const Ended back = Send({"follow", "hall", "backwards", "..2.5", "--wait"});
  EXPECT_EQ(back.status, 0) << back.output << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 3.5, 0.25) << "in reverse gear from where it stood";
  const Ended history = Missions({"--route", "hall"});
  EXPECT_THAT(history.output, AllOf(HasSubstr("first"), HasSubstr("arrived"),
                                    HasSubstr("follow hall ..2 wait 0.5"), HasSubstr("operator")));
  agent_->Signal(SIGTERM);
  EXPECT_EQ(End(*agent_).status, 0) << agent_->output();
}

TEST_F(MissionsTest, ProgramsAreToldThatARobotIsLostWithoutReadingItsWords) {
  robot_ = Robot("robot1", {}, "5.8,7\n2.3,7\n");  // in the next room
  agent_ = Serve("robot1");
  ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  const Ended sent = Send({"follow", "hall", "--wait", "--json"});
  EXPECT_EQ(sent.status, 1) << sent.output << agent_->output();
  EXPECT_THAT(sent.output, HasSubstr("\"state\": \"failed\"")) << agent_->output();
  EXPECT_THAT(sent.output, HasSubstr("\"waits_for\": \"place\"")) << agent_->output();
}

TEST_F(MissionsTest, ASecondOneQueuesAndOnesThatCannotBeDoneAreRefusedInWords) {
  GoOnDuty();
  const Ended unknown = Send({"follow", "attic", "--wait"});
  EXPECT_EQ(unknown.status, 1) << unknown.output;
  EXPECT_THAT(unknown.output, AllOf(HasSubstr("robot1: refused"), HasSubstr("attic")));
  EXPECT_EQ(Send({"wait", "600", "--id", "long"}).status, 0);
  const Ended queued = Send({"follow", "hall", "..2", "--id", "next"});
  EXPECT_EQ(queued.status, 0) << queued.output;
  EXPECT_THAT(queued.output, HasSubstr("waits: it does mission long: wait 600"));
  const Ended cancelled = Tool({"cancel", "robot1"});
  EXPECT_EQ(cancelled.status, 0) << cancelled.output;
  EXPECT_TRUE(agent_->WaitForOutput("cancelled by an operator")) << agent_->output();
  EXPECT_THAT(Missions({"--state", "cancelled"}).output,
              AllOf(HasSubstr("long"), Not(HasSubstr("attic"))));
  EXPECT_THAT(Missions({"--commands"}).output, AllOf(HasSubstr("operator  cancel   robot1"),
                                                     HasSubstr("mission cancelled by operator")));
  EXPECT_THAT(Missions({"--open"}).output, HasSubstr("no missions")) << "the queue, too";
  EXPECT_EQ(Send({"dance"}).status, 2);
}

TEST_F(MissionsTest, AQueueOutlastsTheServerIsHeldAfterAFailureAndAStopAndGoesOnWhenResumed) {
  GoOnDuty();
  ASSERT_EQ(Send({"wait", "600", "--id", "now"}).status, 0);
  ASSERT_TRUE(agent_->WaitForOutput("mission now of operator")) << agent_->output();
  for (const char* id : {"second", "third"}) {
    const Ended queued =
        Send({"follow", id == std::string("second") ? "attic" : "hall", "--id", id});
    EXPECT_EQ(queued.status, 0) << queued.output;
    EXPECT_THAT(queued.output, HasSubstr("waits: "));
  }
  server_->Signal(SIGKILL);
  (void)End(*server_);
  server_ = Server("server.db", "server2");
  const auto open = [this](const std::string& text) {
    return WaitUntil([&] { return Missions({"--open"}).output.find(text) != std::string::npos; });
  };
  ASSERT_TRUE(open("waits: mission second comes before: follow attic"))
      << Missions({"--open"}).output;
  ASSERT_TRUE(open("waits: it does mission now: wait 600")) << Missions({"--open"}).output;

  // The work is ended without the queue: what comes next is told by the end of what is before it.
  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  std::filesystem::remove(Path("routes.db.robot1.missions"));
  agent_ = Serve("robot1", "duty2");
  ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  ASSERT_TRUE(open("waits: mission now did not arrive (failed)")) << Missions({"--open"}).output;
  EXPECT_EQ(Tool({"stop", "robot1"}).status, 0);
  EXPECT_EQ(Tool({"release", "robot1"}).status, 0);
  EXPECT_THAT(agent_->output(), Not(HasSubstr("mission second")));
  EXPECT_EQ(Tool({"resume", "robot1"}).status, 0);
  ASSERT_TRUE(open("waits: mission second did not arrive (refused)"))
      << Missions({"--open"}).output;
  EXPECT_EQ(Tool({"resume", "robot1"}).status, 0);
  const Ended third = Send({"follow", "hall", "--id", "third", "--wait"});
  EXPECT_EQ(third.status, 0) << third.output << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.5, 0.25);

  const Ended again = Send({"--again", "second", "--wait"});
  EXPECT_EQ(again.status, 1) << again.output;
  EXPECT_THAT(again.output, AllOf(HasSubstr("robot1: refused"), HasSubstr("attic")));
  const Ended unknown = Send({"--again", "nothing"});
  EXPECT_EQ(unknown.status, 1) << unknown.output;
  EXPECT_THAT(unknown.output, HasSubstr("no server keeps a mission 'nothing'"));
  EXPECT_EQ(Send({}).status, 2);
  EXPECT_EQ(Send({"wait", "1", "--again", "second"}).status, 2);
}

TEST_F(MissionsTest, APausedMissionGoesOnAndNothingMovesByItselfAfterARestart) {
  GoOnDuty();
  ASSERT_EQ(Send({"follow", "hall", "--id", "trip"}).status, 0);
  ASSERT_TRUE(agent_->WaitForOutput("segment 1: ")) << agent_->output();
  EXPECT_EQ(Tool({"pause", "robot1"}).status, 0);
  ASSERT_TRUE(agent_->WaitForOutput("trip of operator")) << agent_->output();
  ASSERT_TRUE(agent_->WaitForOutput("paused: paused by operator")) << agent_->output();
  ASSERT_TRUE(Stands("truth.csv"));
  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  const double at_m = Along_m("truth.csv");
  server_->Signal(SIGKILL);
  (void)End(*server_);

  server_ = Server("server.db", "server2");
  agent_ = Serve("robot1", "duty2");
  ASSERT_TRUE(
      agent_->WaitForOutput("paused: its agent has started again in the middle of mission "
                            "trip"))
      << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), at_m, 0.05);
  const Ended paused = Missions({"--state", "paused"});
  EXPECT_THAT(paused.output, AllOf(HasSubstr("trip"), HasSubstr("has started again")));
  EXPECT_EQ(Tool({"resume", "robot1"}).status, 0);
  const Ended arrived = Send({"follow", "hall", "--id", "trip", "--wait"});
  EXPECT_EQ(arrived.status, 0) << arrived.output << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.5, 0.25);
}

TEST_F(MissionsTest, ARobotThatIsOutOfReachGetsItsMissionWhenItIsBack) {
  most_mps_ = kUnwatched_mps;
  const Ended unknown = Send({"follow", "hall", "--id", "later"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.output,
              AllOf(HasSubstr("no robot 'robot1' is known"), HasSubstr("--unheard")));
  const Ended kept = Send({"follow", "hall", "--id", "later", "--unheard"});
  EXPECT_EQ(kept.status, 0) << kept.output;
  EXPECT_THAT(kept.output, HasSubstr("a server keeps it"));
  const Ended expired =
      Send({"follow", "hall", "--id", "never", "--valid", "1s", "--unheard", "--wait"});
  EXPECT_EQ(expired.status, 1) << expired.output;
  EXPECT_THAT(expired.output, HasSubstr("robot1: expired"));
  GoOnDuty();
  ASSERT_TRUE(agent_->WaitForOutput("mission later of operator")) << agent_->output();
  const Ended arrived = Send({"follow", "hall", "--id", "later", "--wait"});
  EXPECT_EQ(arrived.status, 0) << arrived.output << agent_->output();
  EXPECT_THAT(agent_->output(), Not(HasSubstr("never")));
}

TEST_F(MissionsTest, WithoutARobotOrAServerThatIsSaid) {
  server_->Signal(SIGTERM);
  (void)End(*server_);
  const Ended sent = Send({"follow", "hall", "--timeout", "1"});
  EXPECT_EQ(sent.status, 1);
  EXPECT_THAT(sent.output, HasSubstr("neither robot1 nor a route server answered"));
  const Ended history = Missions({"--timeout", "1"});
  EXPECT_EQ(history.status, 1);
  EXPECT_THAT(history.output, HasSubstr("no route server answered"));
}

}  // namespace
}  // namespace trailcast::test
