// A route over rough ground: taught with an IMU, refused, driven more slowly.
#include <charconv>

#include "tests/scenario/robots.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class GroundTest : public RobotsTest {
 protected:
  void TeachOver(const Words& ground, const std::string& store) {
    const auto robot = Robot("scout", With({"--scout", "--lockstep"}, ground));
    const auto scout =
        RunAgent(With(With({"teach", "--route", "hall", "--store", Path(store)}, Drives("scout")),
                      {"--imu-topic", "imu", "--lockstep", "--end-when-still", "1"}));
    ASSERT_EQ(scout.status, 0) << scout.output << robot->output();
  }
  // Returns the end of a robot that follows what is in the store.
  ProgramsTest::Ended FollowedFrom(const std::string& store, const Words& words) {
    const auto robot = Robot("robot1", {"--lockstep", "--seed", "7"});
    EXPECT_TRUE(robot->WaitForOutput("in lockstep")) << robot->output();
    const auto follower = Follow("robot1", store, With({"--lockstep"}, words));
    auto ended = End(*follower);
    robot->Signal(SIGTERM);
    EXPECT_EQ(End(*robot).status, 0);
    return ended;
  }
  static int FramesIn(const std::string& summary) {
    int frames = 0;
    const auto at = summary.find("frames=");
    if (at == std::string::npos) return 0;
    std::from_chars(summary.data() + at + 7, summary.data() + summary.size(), frames);
    return frames;
  }
};

TEST_F(GroundTest, RoughGroundIsRefusedByWhomItIsTooRoughForAndDrivenSlowlyForComfort) {
  TeachOver({"--rough", "3.2,1.5,0.9,0.02"}, "rough.db");
  const auto refused = FollowedFrom("rough.db", {"--max-roughness", "smooth"});
  EXPECT_EQ(refused.status, 3) << refused.output;
  EXPECT_THAT(
      refused.output,
      AllOf(HasSubstr("state=REFUSED"), HasSubstr("m along the route, the ground is "),
            HasSubstr("this robot's limit is smooth (--max-roughness)"), HasSubstr("frames=0")));
  const auto as_taught = FollowedFrom("rough.db", {"--max-roughness", "very-rough"});
  EXPECT_THAT(as_taught.output, HasSubstr("state=ARRIVED"));
  const auto slowly = FollowedFrom("rough.db", {"--comfort"});
  EXPECT_THAT(slowly.output, HasSubstr("state=ARRIVED"));
  EXPECT_GT(FramesIn(slowly.output), FramesIn(as_taught.output) + 20);
}

TEST_F(GroundTest, SmoothAndLevelGroundIsRefusedByNobody) {
  TeachOver({}, "smooth.db");
  const auto followed =
      FollowedFrom("smooth.db", {"--max-roughness", "smooth", "--max-slope", "1", "--comfort"});
  EXPECT_EQ(followed.status, 0) << followed.output;
  EXPECT_THAT(followed.output, AllOf(HasSubstr("state=ARRIVED"), Not(HasSubstr("not known"))));
}

}  // namespace
}  // namespace trailcast::test
