#include "services/lab/simulated/simulated_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

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
  [[nodiscard]] std::vector<Eigen::Vector2d> TruePositions() const {
    std::vector<Eigen::Vector2d> at_m;
    std::ifstream in(run_.truth);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      double t_s = 0.0;
      Eigen::Vector2d& each_m = at_m.emplace_back();
      EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t_s, &each_m.x(), &each_m.y()), 3);
    }
    return at_m;
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

TEST_F(SimulatedDeviceTest, SomebodyCarriesItOffOnceAndItsWheelsDoNotFeelIt) {
  run_.truth = folder_ / "truth.csv";
  run_.carried = CarriedOff{0.3, {9.0, 6.5, 1.5}};
  const auto opened = SimulatedDevice::Open(run_);
  ASSERT_TRUE(opened) << opened.error().message;
  motion::Pose2 last;
  for (int i = 0; i < 60; ++i) {
    const auto seen = (*opened)->Next();
    ASSERT_TRUE(seen && *seen);
    const motion::Pose2 now = *(*seen)->odometry;
    EXPECT_LT((motion::Position(now) - motion::Position(last)).norm(), 0.05);
    last = now;
    ASSERT_TRUE((*opened)->Drive({0.5, 0.0}));
  }
  const std::vector<Eigen::Vector2d> at_m = TruePositions();
  const Eigen::Vector2d to_m(9.0, 6.5);
  const auto there = std::find_if(at_m.begin(), at_m.end(), [&](const Eigen::Vector2d& each) {
    return (each - to_m).norm() < 0.1;
  });
  ASSERT_NE(there, at_m.begin());
  ASSERT_NE(there, at_m.end());
  EXPECT_NEAR((*(there - 1) - at_m.front()).norm(), 0.3, 0.05);
  EXPECT_NEAR(at_m.back().y(), 6.5 + last.x_m - 0.3, 0.1) << "it drives on from there";
}

TEST_F(SimulatedDeviceTest, ItsBatteryFallsAndChargesAtTheChargerAlone) {
  run_.battery_minutes = 0.1;
  run_.charger = Charger{2.5, 1.5, 0.05};
  const auto opened = SimulatedDevice::Open(run_);
  ASSERT_TRUE(opened) << opened.error().message;
  SimulatedDevice& device = **opened;
  std::vector<int> told;
  const auto look = [&](double speed_mps, int frames) {
    for (int i = 0; i < frames; ++i) {
      ASSERT_TRUE(device.Next());
      ASSERT_TRUE(device.Drive({speed_mps, 0.0}));
    }
    told.push_back(*device.battery_percent());
  };
  look(0.0, 60);
  look(0.5, 60);
  look(0.5, 30);
  look(0.0, 120);
  EXPECT_NEAR(told[0], 67, 2) << "after 2 s of 6";
  EXPECT_LT(told[1], told[0]);
  EXPECT_GT(told[3], told[2]) << "1.5 m on, it is there";
  EXPECT_EQ(told[3], 100);
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
