// A robot whose ROS 2 nodes run over Fast DDS is taught a path and follows it.
#include <fstream>
#include <optional>

#include "tests/interop/fast_dds_programs.h"
#include "tests/scenario/programs.h"
#include "tests/support/network_lab.h"
#include "tests/support/places.h"

namespace trailcast::test {
namespace {

using testing::HasSubstr;

constexpr const char* kDomain = "7";  // of a computer of its own
constexpr int kHost = 1;
constexpr int kOtherHost = 2;
constexpr double kLost = 0.05;
constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr int kPictures = 120;

// By what the robot's nodes are told of the network.
class FastDdsRobot : public ProgramsTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (std::string(kFastDdsRobot).empty()) GTEST_SKIP() << kNoFastDds;
    if (const std::string obstacle = NetworkLab::Obstacle(); !obstacle.empty()) {
      GTEST_SKIP() << obstacle;
    }
    lab_.emplace();
    lab_->AddHost(kHost);
    if (Loses()) {
      lab_->AddHost(kOtherHost);
      lab_->Lose(kHost, kLost);
      lab_->Lose(kOtherHost, kLost);
      // The doctor advises it. Without it pictures, which come in pieces, stop coming.
      lab_->KeepPiecesFor(kOtherHost, 3);
    }
    std::ofstream film(Path("film"), std::ios::binary);
    for (int i = 0; i < kPictures; ++i) {
      const image::GrayImage picture = WalkFrame(i, kWidth, kHeight);
      film.write(reinterpret_cast<const char*>(picture.pixels.data()),
                 static_cast<std::streamsize>(picture.pixels.size()));
    }
  }
  // Data, which has to be of a fixed size.
  [[nodiscard]] static bool Shares() { return GetParam() == std::string("data-sharing"); }
  // The agent runs on another computer, and either loses a part of the packets for it.
  [[nodiscard]] static bool Loses() { return GetParam() == std::string("loss"); }
  std::unique_ptr<Process> Robot(const std::string& does) {
    return std::make_unique<Process>(
        lab_->At(kHost, {kFastDdsRobot, kDomain, Loses() ? "default" : GetParam(), Path("film"),
                         std::to_string(kWidth), std::to_string(kHeight), does}),
        Path("robot-" + does + ".log"));
  }
  Ended RunAgentOfRobot(const std::string& command, const Words& words) {
    Process agent(
        lab_->At(Loses() ? kOtherHost : kHost,
                 With({ProgramsDir() + "/trailcast-agent", command, "--ros2", "/robot1",
                       "--ros-domain", kDomain, "--route", "hall", "--store", Path("routes.db"),
                       "--cmd-vel-type", Shares() ? "twist" : "twist_stamped"},
                      words)),
        Path(command + ".log"));
    return End(agent);
  }

  std::optional<NetworkLab> lab_;
};

INSTANTIATE_TEST_SUITE_P(Settings, FastDdsRobot,
                         testing::Values("default", "localhost-only", "localhost-range",
                                         "data-sharing", "loss"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(FastDdsRobot, IsTaughtAndFollows) {
  {
    const auto robot = Robot("drive");
    const auto taught = RunAgentOfRobot("teach", {"--end-when-still", "1"});
    ASSERT_EQ(taught.status, 0) << taught.output << robot->output();
  }
  const auto robot = Robot("obey");
  const auto followed = RunAgentOfRobot("replay", {});
  EXPECT_EQ(followed.status, 0) << followed.output << robot->output();
  EXPECT_THAT(followed.output, HasSubstr("state=ARRIVED"));
}

}  // namespace
}  // namespace trailcast::test
