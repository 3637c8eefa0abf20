#include "agent/simulated/simulated_device.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "services/base/time.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

class SimulatedDeviceTest : public testing::Test {
 protected:
  SimulatedDeviceTest() {
    std::ofstream(folder_ / "path.csv") << "x_m,y_m\n1,1.5\n1.5,1.5\n";
    run_.place.world = "indoor";
    run_.place.path = (folder_ / "path.csv").string();
    run_.camera = "webcam+width=80+height=60";
  }
  test::TempDir folder_;
  SimulatedRun run_;
};

TEST_F(SimulatedDeviceTest, SomebodyDrivesItByHandAlongItsPathAndLeavesItThen) {
  run_.has_driver = true;
  const auto opened = SimulatedDevice::Open(run_);
  ASSERT_TRUE(opened) << opened.error().message;
  SimulatedDevice& device = **opened;
  double ahead_m = 0.0;
  const auto look = [&] {
    const auto seen = device.Next();
    if (!seen || !*seen) return false;
    ahead_m = (*seen)->odometry->x_m;
    return true;
  };
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(look());
  EXPECT_NEAR(ahead_m, 0.0, 0.01);
  device.ByHand(true);
  int frames = 0;
  while (look()) ASSERT_LT(++frames, 1000);
  EXPECT_NEAR(ahead_m, 0.5, 0.1);
  device.ByHand(false);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(look()) << "it goes on looking";
  const double stood_m = ahead_m;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(look());
  EXPECT_NEAR(ahead_m, stood_m, 0.01);
}

TEST(SimulatedDevice, InRealTimeItsTimePassesNoFasterThanOurs) {
  SimulatedRun run;
  run.place.world = "indoor";
  run.in_real_time = true;
  const auto device = SimulatedDevice::Open(run);
  ASSERT_TRUE(device.has_value()) << device.error().message;
  const auto began = std::chrono::steady_clock::now();
  const auto first = (*(*device)->Next())->stamp;
  auto last = first;
  for (int i = 0; i < 9; ++i) last = (*(*device)->Next())->stamp;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  EXPECT_NEAR(Seconds(last - first), 9.0 / 30.0, 1e-3);
  EXPECT_GE(took.count(), 9.0 / 30.0 - 1e-3);
}

}  // namespace
}  // namespace trailcast::agent
