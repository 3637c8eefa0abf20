// Agents that drive virtual robots over ROS 2's topics.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/scenario/robots.h"
#include "tests/support/places.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RobotTest : public RobotsTest {
 protected:
  // Where along x it stood for longest.
  static double LongestStand(const std::vector<Place>& places) {
    double at_m = 0.0;
    double best_m = 0.0;
    int frames = 0;
    int most = 0;
    for (const Place& place : places) {
      const double x_m = place.x_m;
      frames = std::abs(x_m - at_m) < 0.005 ? frames + 1 : 0;
      if (frames == 0) at_m = x_m;
      if (x_m > 1.5 && x_m < 4.0 && frames > most) {
        most = frames;
        best_m = x_m;
      }
    }
    return best_m;
  }
};

TEST_F(RobotTest, InLockstepAFollowerWithAnotherCameraArrives) {
  Teach();
  const auto robot = Robot("robot1", {"--camera", "wide", "--seed", "7", "--lockstep"});
  const auto follower = Follow({"--lockstep"});
  EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
  EXPECT_THAT(follower->output(), HasSubstr("state=ARRIVED"));
  robot->Signal(SIGTERM);
  EXPECT_EQ(End(*robot).status, 0);
  EXPECT_GT(Number(robot->output(), "commands"), 200.0);
}

// Not seen in the picture, which is another matter.
TEST_F(RobotTest, AFollowerWaitsBeforeWhatStandsInItsWayAndArrives) {
  Teach();
  for (const Words& sensor :
       {Words{"--scan-topic", "scan"}, Words{"--range-topic", "range@0.25,0,0"}}) {
    SCOPED_TRACE(sensor.front());
    const auto robot = Robot("robot1", {"--seed", "3", "--sim-truth", Path("truth.csv"),
                                        "--obstacle", "3,1.5,0.2@0+12", "--lockstep"});
    ASSERT_TRUE(robot->WaitForOutput("in lockstep")) << robot->output();
    const auto follower =
        Follow(With(sensor, {"--robot-width", "0.4", "--log", Path("run.mcap"), "--sensor-patience",
                             "1", "--base-patience", "1", "--lockstep"}));
    ASSERT_TRUE(follower->WaitForOutput("WAITING: something stands")) << follower->output();
    EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
    EXPECT_THAT(follower->output(),
                AllOf(HasSubstr("in the way: the robot waits"), HasSubstr("the way is free"),
                      HasSubstr("state=ARRIVED")));
    ASSERT_NO_FATAL_FAILURE(EndAtThePathsEnd(*robot));
    const auto places = TruePlaces();
    // Its front is 0.2 m ahead of its axle, the obstacle's near side at 2.8 m.
    const double stood_m = LongestStand(places);
    EXPECT_LE(stood_m, 2.8 - 0.2 - 0.2);
    EXPECT_GT(stood_m, 2.8 - 0.2 - 0.5);
  }
}

// Half on the path that it was taught, and for its scanner alone.
TEST_F(RobotTest, AFollowerThatMayGoesRoundWhatStandsOnItsPath) {
  constexpr const char* kRoom = "1,1.5\n5.3,1.5\n";  // enough to come back in
  Teach("routes.db", kRoom);
  const auto robot = Robot("robot1", {"--seed", "3", "--sim-truth", Path("truth.csv"), "--obstacle",
                                      "2.8,1.75,0.15@0", "--lockstep"});
  ASSERT_TRUE(robot->WaitForOutput("in lockstep")) << robot->output();
  const auto follower = Follow({"--scan-topic", "scan", "--pass-obstacles", "0.8", "--robot-width",
                                "0.4", "--lockstep", "--log", Path("run.mcap")});
  EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
  EXPECT_THAT(follower->output(),
              AllOf(HasSubstr("passes what stands on the path"), HasSubstr("state=ARRIVED")));
  robot->Signal(SIGTERM);
  ASSERT_EQ(End(*robot).status, 0) << robot->output();
  const auto places = TruePlaces();
  ASSERT_FALSE(places.empty());
  EXPECT_NEAR(places.back().x_m, 5.3, 0.2);
  EXPECT_NEAR(places.back().y_m, 1.5, 0.1) << follower->output() << robot->output();
  for (const Place& place : places) {
    ASSERT_GT(std::hypot(place.x_m - 2.8, place.y_m - 1.75), 0.15 + 0.2)
        << "it touched what it went round";
  }
}

TEST_F(RobotTest, WithoutOdometryATeachingEndsWhereTheRobotStands) {
  const auto robot = Robot("scout", {"--scout", "--lockstep", "--sim-truth", Path("truth.csv")});
  const auto scout = RunAgent(
      With(With({"teach", "--route", "hall", "--store", Path("routes.db")}, Drives("scout")),
           {"--odom-topic", "", "--lockstep", "--end-when-still", "1"}));
  EXPECT_EQ(scout.status, 0) << scout.output << robot->output();
  robot->Signal(SIGTERM);
  ASSERT_EQ(End(*robot).status, 0) << robot->output();
  const auto places = TruePlaces();
  ASSERT_GT(places.size(), 30U);
  EXPECT_NEAR(places.back().x_m, 4.5, 0.1) << "the whole path";
  const auto at_its_end = std::find_if(places.begin(), places.end(), [&](const Place& place) {
    return std::abs(place.x_m - places.back().x_m) < 0.005;
  });
  const auto stood = places.end() - at_its_end;
  EXPECT_GE(stood, 30) << "frames, of 30 a second";
  EXPECT_LE(stood, 120) << "brakes and all";
}

TEST_F(RobotTest, ACarArrives) {
  Teach();
  const auto robot = Robot("robot1", {"--seed", "7", "--lockstep", "--turn-radius", "0.6",
                                      "--sim-truth", Path("truth.csv")});
  const auto follower = Follow({"--lockstep", "--min-turn-radius", "0.6", "--max-speed", "0.3"});
  EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
  EndAtThePathsEnd(*robot);
}

// Nobody has said so, to the scout's agent or to the followers'.
TEST_F(RobotTest, AFleetWhoseCamerasHangOtherwiseTeachesAndFollowsAllTheSame) {
  constexpr const char* kBends = "1,1.5\n2.3,1.5\n3.2,1.9\n4.5,1.9\n";
  for (const std::string roll_deg : {"180", "90"}) {
    SCOPED_TRACE(roll_deg);
    const std::string camera = "webcam+roll_deg=" + roll_deg;
    const std::string scout = "scout" + roll_deg;
    const std::string follower = "robot" + roll_deg;
    const std::string store = roll_deg + ".db";
    const auto drives = Robot(scout, {"--scout", "--lockstep", "--camera", camera}, kBends);
    const auto taught =
        RunAgent(With(With({"teach", "--route", "hall", "--store", Path(store)}, Drives(scout)),
                      {"--lockstep", "--end-when-still", "1"}));
    ASSERT_EQ(taught.status, 0) << taught.output << drives->output();
    EXPECT_THAT(taught.output,
                AllOf(HasSubstr("the camera looks"), HasSubstr("taught anew from its beginning"),
                      HasSubstr("--camera-roll " + roll_deg)));
    const auto robot =
        Robot(follower,
              {"--seed", "7", "--lockstep", "--camera", camera, "--sim-truth", Path("truth.csv")},
              kBends);
    const auto replay = Follow(follower, store, {"--lockstep"}, "follower" + roll_deg);
    EXPECT_EQ(End(*replay).status, 0) << replay->output() << robot->output();
    EXPECT_THAT(replay->output(),
                AllOf(HasSubstr("against the one that taught"), HasSubstr("state=ARRIVED")));
    robot->Signal(SIGTERM);
    ASSERT_EQ(End(*robot).status, 0) << robot->output();
    const auto places = TruePlaces();
    ASSERT_FALSE(places.empty());
    EXPECT_NEAR(places.back().x_m, 4.5, 0.4);
    EXPECT_NEAR(places.back().y_m, 1.9, 0.25);
  }
}

TEST_F(RobotTest, AnAgentWithoutARobotSaysWhatIsMissing) {
  Teach();
  const auto follower = Follow({"--sensor-patience", "0.5"});
  EXPECT_EQ(End(*follower).status, 1);
  EXPECT_THAT(follower->output(),
              AllOf(HasSubstr("nobody publishes /robot1/image_raw; looked on the loopback"),
                    HasSubstr("(ROS domain 3)")));
}

TEST_F(RobotTest, ARobotWithoutAnAgentEndsWithASignal) {
  const auto robot = Robot("robot1", {"--sim-truth", Path("truth.csv")});
  robot->Signal(SIGINT);
  EXPECT_EQ(End(*robot).status, 0) << robot->output();
  EXPECT_TRUE(std::filesystem::exists(Path("truth.csv")));
}

TEST_F(RobotTest, ARosDomainInTheEnvironmentAsksForNoRobot) {
  std::ofstream(Path("path.csv")) << "x_m,y_m\n" << kPath;
  Process agent(
      {"/usr/bin/env", "ROS_DOMAIN_ID=3", ProgramsDir() + "/trailcast-agent", "teach", "--sim",
       "indoor", "--path", Path("path.csv"), "--route", "hall", "--store", Path("routes.db")},
      Path("env.log"));
  EXPECT_EQ(End(agent).status, 0) << agent.output();
}

TEST_F(RobotTest, FaultsAreNamedWhenOneIsNotUnderstood) {
  for (const char* fault : {"camera-burns@3", "base-stops", "base-stops@", "base-stops@-1"}) {
    const auto robot = BeginRobot("robot1", {"--fail", fault});
    EXPECT_EQ(End(*robot).status, 2) << fault;
    EXPECT_THAT(robot->output(), HasSubstr("expected one of camera-freezes"));
  }
}

}  // namespace
}  // namespace trailcast::test
