#include "agent/simulated/simulated_device.h"

#include <gtest/gtest.h>

#include <chrono>

#include "services/base/time.h"

namespace trailcast::agent {
namespace {

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
