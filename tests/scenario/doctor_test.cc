// These test what the doctor says of recorded drives: of one simulated robot, whose odometry is
// good in one recording and lies in the others.
#include "services/lab/simulated/simulated_device.h"
#include "services/lab/trial/recording/odometry_noise.h"
#include "tests/scenario/programs.h"
#include "tests/support/recorded/bag_writers.h"
#include "tests/support/recorded/ros_messages.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kDrive_s = 30.0;
constexpr std::chrono::nanoseconds kDayOfDrive = std::chrono::seconds(1'700'000'000);

class DoctorTest : public ProgramsTest {
 protected:
  // One drive along the built-in path, into as many recordings as there are lies, NAME.mcap.
  struct Lie {
    std::string name;
    std::string noise;  // as 'trailcast judge --odometry-noise' has it
  };
  void Record(const std::vector<Lie>& lies) {
    agent::SimulatedRun run;
    run.place.world = "indoor";
    run.drives_itself = true;
    const auto robot = agent::SimulatedDevice::Open(run);
    ASSERT_TRUE(robot) << robot.error().message;
    std::vector<std::unique_ptr<McapBagWriter>> bags;
    std::vector<trial::OdometrySpoiler> spoilers;
    for (const Lie& lie : lies) {
      bags.push_back(
          std::make_unique<McapBagWriter>(Path(lie.name + ".mcap"), bag::Compression::kNone));
      const auto noise = trial::ParseOdometryNoise(lie.noise);
      ASSERT_TRUE(noise) << noise.error().message;
      spoilers.emplace_back(*noise, kDrive_s, 1);
    }
    while (true) {
      const auto sensed = (*robot)->Next();
      ASSERT_TRUE(sensed) << sensed.error().message;
      if (!*sensed || Seconds((*sensed)->stamp) > kDrive_s) return;
      const auto at = kDayOfDrive + (*sensed)->stamp;
      const auto picture = ImageMessage(at, (*sensed)->image);
      for (std::size_t i = 0; i < bags.size(); ++i) {
        bags[i]->Put("/image_raw", "sensor_msgs/msg/Image", at, picture);
        const auto told = spoilers[i].Tell((*sensed)->stamp, *(*sensed)->odometry);
        bags[i]->Put("/odom", "nav_msgs/msg/Odometry", at, OdometryMessage(at, told));
      }
    }
  }
  Ended Doctor(const std::string& name, const Words& words = {}) {
    return End(*Start("trailcast", With({"doctor", "--bag", Path(name + ".mcap")}, words), name));
  }
};

TEST_F(DoctorTest, NamesWhatIsWrongWithAnOdometryAndHasNothingAgainstAGoodOne) {
  Record({{"good", "none"},
          {"late", "delay=0.3"},
          {"wide", "turn=1.3"},
          {"mirrored", "turn=-1"},
          {"frozen", "frozen=2"}});
  const Words camera{"--fov", "60"};
  const auto good = Doctor("good", camera);
  EXPECT_EQ(good.status, 0) << good.output;
  EXPECT_THAT(good.output, AllOf(HasSubstr("ok    delay:"), HasSubstr("ok    turns:"),
                                 HasSubstr("ok    drift:"), Not(HasSubstr("warn  ")),
                                 Not(HasSubstr("BAD  ")), Not(HasSubstr("receive buffer"))));
  const auto late = Doctor("late", camera);
  EXPECT_EQ(late.status, 0) << late.output;
  EXPECT_THAT(
      late.output,
      AllOf(testing::ContainsRegex("warn  delay: odometry turns 0\\.(29|30|31|32|33) s after"),
            HasSubstr("ok    turns:")));
  const auto wide = Doctor("wide", camera);
  EXPECT_THAT(
      wide.output,
      AllOf(testing::ContainsRegex("warn  turns: odometry counts each 1\\.(2[0-9]|3[0-9]) times"),
            HasSubstr("ok    delay:")));
  EXPECT_THAT(Doctor("wide").output, HasSubstr("ok    turns: odometry and picture turn the same"))
      << "without knowing the camera";
  const auto mirrored = Doctor("mirrored");
  EXPECT_EQ(mirrored.status, 1) << mirrored.output;
  EXPECT_THAT(mirrored.output, HasSubstr("BAD   turns: odometry turns to the other side"));
  // This is for as long as the picture moves beyond doubt meanwhile.
  EXPECT_THAT(Doctor("frozen").output,
              testing::ContainsRegex("warn  frozen: odometry stands while the picture moves, from "
                                     "[0-9.]+ s for (1\\.[0-9]|2\\.[0-2]) s"));
}

TEST_F(DoctorTest, AsksForWhatItNeeds) {
  const auto nothing = End(*Start("trailcast", {"doctor", "--fov", "60"}, "fov"));
  EXPECT_NE(nothing.status, 0);
  EXPECT_THAT(nothing.output, HasSubstr("--drive, --bag or --frames"));
  const auto alone = End(*Start("trailcast", {"doctor", "--drive"}, "drive"));
  EXPECT_NE(alone.status, 0);
  EXPECT_THAT(alone.output, HasSubstr("--ros2"));
  const auto absent = Doctor("absent");
  EXPECT_EQ(absent.status, 1) << absent.output;
  EXPECT_THAT(absent.output, HasSubstr("absent.mcap"));
}

}  // namespace
}  // namespace trailcast::test
