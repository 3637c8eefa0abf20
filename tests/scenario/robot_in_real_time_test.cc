// An agent follows a virtual robot that keeps pace with the clock, and over what real ones do.
#include <string>
#include <vector>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

struct Life {
  const char* name;
  std::vector<std::string> robot;
  std::vector<std::string> said;
};

class RobotInRealTime : public RobotsTest, public testing::WithParamInterface<Life> {};

TEST_P(RobotInRealTime, IsFollowed) {
  Teach();
  const auto robot =
      Robot("robot1", With({"--sim-truth", Path("truth.csv"), "--seed", "3"}, GetParam().robot));
  const auto follower = Follow({});
  EXPECT_EQ(End(*follower).status, 0) << follower->output() << robot->output();
  EXPECT_THAT(follower->output(), HasSubstr("state=ARRIVED"));
  for (const std::string& word : GetParam().said) {
    EXPECT_THAT(follower->output(), HasSubstr(word));
  }
  EndAtThePathsEnd(*robot);
}

INSTANTIATE_TEST_SUITE_P(
    Lives, RobotInRealTime,
    testing::Values(Life{"SafetyStops",
                         {"--fail", "base-stops@2+0.5", "--fail", "base-stops@4+4"},
                         {"by its odometry it stands", "over: base /robot1/cmd_vel"}},
                    Life{"Odometry",
                         {"--fail", "odometry-jumps@2", "--fail", "odometry-restarts@5"},
                         {"odometry jumped by "}},
                    Life{"Clocks",
                         {"--fail", "camera-clock-back@2", "--fail", "odometry-clock-back@4",
                          "--fail", "camera-stamps-stand@6+1"},
                         {"pictures: its clock went back by ", "odometry: its clock went back by ",
                          "pictures: its stamps stand still"}},
                    Life{"StampsOfTwoClocks", {"--stamps-late", "1.5"}, {"different clocks, 1."}},
                    Life{"Delays", {"--picture-delay", "0.2", "--base-delay", "0.2"}, {}},
                    Life{"FewPictures", {"--picture-rate", "8", "--drop-pictures", "0.3"}, {}}),
    [](const testing::TestParamInfo<Life>& life) { return life.param.name; });

}  // namespace
}  // namespace trailcast::test
