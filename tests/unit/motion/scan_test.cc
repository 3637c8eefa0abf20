#include "services/motion/scan.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace trailcast::motion {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Scan Looking(std::vector<float> ranges_m) {
  return {-std::numbers::pi / 2.0, std::numbers::pi / 2.0, 0.1, 10.0, std::move(ranges_m)};
}

TEST(Scan, WhatCannotBeMeasuredIsNothing) {
  for (const float range_m : {kNan, kInf, 0.0F, 0.05F, 11.0F, -1.0F}) {
    EXPECT_FALSE(Measured(Looking({}), range_m)) << range_m;
  }
  Scan any = Looking({});
  any.least_m = 0.0;
  any.most_m = kInf;
  EXPECT_FALSE(Measured(any, 0.0F));
  EXPECT_FALSE(Measured(any, kInf));
  EXPECT_EQ(Measured(any, 1.5F), 1.5);
}

TEST(Scan, WhatIsTooNearToBeMeasuredIsThere) { EXPECT_EQ(Measured(Looking({}), -kInf), 0.1); }

TEST(Scan, ThatCanBeNoScannersIsTold) {
  EXPECT_TRUE(Plausible(Looking({1.0F, kNan})));
  EXPECT_FALSE(Plausible(Looking({})));
  EXPECT_FALSE(Plausible(Looking(std::vector<float>(kMostRanges + 1, 1.0F))));
  const auto with = [](auto change) {
    Scan scan = Looking({1.0F, 1.0F, 1.0F});
    change(scan);
    return Plausible(scan);
  };
  for (const double number : {double{kNan}, double{kInf}, -double{kInf}}) {
    EXPECT_FALSE(with([&](Scan& scan) { scan.first_rad = number; }));
    EXPECT_FALSE(with([&](Scan& scan) { scan.step_rad = number; }));
    EXPECT_FALSE(with([&](Scan& scan) { scan.least_m = number; }));
  }
  EXPECT_FALSE(with([](Scan& scan) { scan.step_rad = 0.0; }));
  EXPECT_FALSE(with([](Scan& scan) { scan.step_rad = 7.0; }));
  EXPECT_FALSE(with([](Scan& scan) { scan.first_rad = 100.0; }));
  EXPECT_FALSE(with([](Scan& scan) { scan.least_m = -0.1; }));
  EXPECT_FALSE(with([](Scan& scan) { scan.most_m = kNan; }));
  EXPECT_TRUE(with([](Scan& scan) { scan.most_m = kInf; }));
}

}  // namespace
}  // namespace trailcast::motion
