// These test what operators tell robots at work: pause, resume, cancel, stop, release.
#include <chrono>
#include <filesystem>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class NowTest : public RobotsTest {
 protected:
  void SetUp() override {
    Teach();
    server_ = Server();
  }
  std::unique_ptr<Process> FollowWithServer(const std::string& log = "follower") {
    return Follow("robot1", "routes.db",
                  {"--server", "--name", "robot1", "--max-speed", kUnhurried_mps}, log);
  }
  // On its way along the route, in real time.
  void Begin() {
    robot_ = Robot("robot1", {"--sim-truth", Path("truth.csv")});
    follower_ = FollowWithServer();
    ASSERT_TRUE(follower_->WaitForOutput("segment 1: ")) << follower_->output();
  }
  Ended Tell(const std::string& order, const Words& words = {"robot1"}) {
    return End(*Start("trailcast", With({order}, words), order));
  }

  std::unique_ptr<Process> server_;
  std::unique_ptr<Process> robot_;
  std::unique_ptr<Process> follower_;
};

TEST_F(NowTest, APausedRobotStandsAndGoesOnWhenItIsToldTo) {
  Begin();
  const Ended paused = Tell("pause", {"robot1", "--reason", "somebody walks here"});
  EXPECT_EQ(paused.status, 0) << paused.output;
  EXPECT_THAT(paused.output, HasSubstr("robot1: paused by operator: somebody walks here"));
  EXPECT_TRUE(follower_->WaitForOutput("HELD")) << follower_->output();
  EXPECT_TRUE(Stands("truth.csv"));
  const double at_m = Along_m("truth.csv");
  EXPECT_LT(at_m, 4.3) << "of 4.5 m";
  const auto watch = Start("trailcast", {"fleet", "--watch", "--json"}, "watch");
  EXPECT_TRUE(watch->WaitForOutput("\"hold\":\"paused\"")) << watch->output();
  watch->Signal(SIGINT);
  EXPECT_EQ(End(*watch).status, 0) << watch->output();
  const Ended resumed = Tell("resume", {"--all"});
  EXPECT_EQ(resumed.status, 0) << resumed.output;
  const Ended followed = End(*follower_);
  EXPECT_EQ(followed.status, 0) << followed.output;
  EXPECT_THAT(followed.output, HasSubstr("state=ARRIVED"));
  EXPECT_THAT(server_->output(), AllOf(HasSubstr("tells 'robot1' to pause: somebody walks here"),
                                       HasSubstr("tells all robots to resume")));
}

TEST_F(NowTest, AStoppedRobotStandsAfterARestartTooUntilItIsReleasedAndResumed) {
  Begin();
  const Ended stopped = Tell("stop", {"--route", "hall"});
  EXPECT_EQ(stopped.status, 0) << stopped.output;
  EXPECT_TRUE(Stands("truth.csv"));
  const double at_m = Along_m("truth.csv");
  follower_->Signal(SIGKILL);
  (void)End(*follower_);

  follower_ = FollowWithServer("again");
  ASSERT_TRUE(follower_->WaitForOutput("HELD")) << follower_->output();
  const Ended refused = Tell("resume");
  EXPECT_EQ(refused.status, 1) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("robot1: does not obey: stopped by operator on "));
  EXPECT_EQ(Tell("release").status, 0);
  EXPECT_TRUE(Stands("truth.csv"));
  EXPECT_NEAR(Along_m("truth.csv"), at_m, 0.05) << "it has not moved";
  EXPECT_EQ(Tell("resume").status, 0);
  const Ended followed = End(*follower_);
  EXPECT_EQ(followed.status, 0) << followed.output;
  EXPECT_THAT(followed.output, HasSubstr("state=ARRIVED"));
}

TEST_F(NowTest, AStoppedRobotWithoutANetworkDoesNotBegin) {
  Begin();
  EXPECT_EQ(Tell("stop").status, 0);
  EXPECT_EQ(Tell("cancel").status, 0);
  const Ended cancelled = End(*follower_);
  EXPECT_EQ(cancelled.status, 3) << cancelled.output;
  EXPECT_THAT(cancelled.output, HasSubstr("state=CANCELLED"));
  const auto alone = Follow("robot1", "routes.db", {"--name", "robot1"}, "alone");
  const Ended refused = End(*alone);
  EXPECT_EQ(refused.status, 1) << refused.output;
  EXPECT_THAT(refused.output,
              AllOf(HasSubstr("stopped by operator on "), HasSubstr("trailcast release robot1")));
}

TEST_F(NowTest, ARecordingDrivesNothingAndDoesNotAnswer) {
  const auto recording =
      Agent({"replay", "--frames", Walk("walk", 3), "--route", "yard", "--store", Path("copy.db"),
             "--server", "--wait-for-route", "--wait", "600", "--name", "recording"});
  ASSERT_TRUE(recording->WaitForOutput("asking for route 'yard'")) << recording->output();
  const Ended stopped = Tell("stop", {"recording", "--timeout", "2"});
  EXPECT_EQ(stopped.status, 1) << stopped.output;
  EXPECT_THAT(stopped.output, HasSubstr("recording: did not answer"));
  EXPECT_FALSE(std::filesystem::exists(Path("copy.db.recording.stop")));
}

TEST_F(NowTest, WhoIsNotThereDoesNotAnswer) {
  const Ended paused = Tell("pause", {"robot7", "--timeout", "1"});
  EXPECT_EQ(paused.status, 1);
  EXPECT_THAT(paused.output, HasSubstr("robot7: did not answer"));
  const Ended nobody = Tell("stop", {"--all", "--timeout", "2"});
  EXPECT_EQ(nobody.status, 1);
  EXPECT_THAT(nobody.output, HasSubstr("no robot that this is meant for was heard"));
  EXPECT_EQ(Tell("stop", {}).status, 2) << "of nobody";
  EXPECT_EQ(Tell("stop", {"robot1", "--all"}).status, 2);
}

}  // namespace
}  // namespace trailcast::test
