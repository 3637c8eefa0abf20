#include "services/motion/battery.h"

#include <gtest/gtest.h>

#include <limits>

namespace trailcast::motion {
namespace {

constexpr float kUnmeasured = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

TEST(BatteryGauge, ReadsAShare) {
  BatteryGauge gauge;
  EXPECT_EQ(gauge.Read(0.0F, kUnmeasured, kUnmeasured), 0);
  EXPECT_EQ(gauge.Read(0.623F, kUnmeasured, kUnmeasured), 62);
  EXPECT_EQ(gauge.Read(1.0F, kUnmeasured, kUnmeasured), 100);
  EXPECT_EQ(gauge.Read(1.02F, kUnmeasured, kUnmeasured), 100) << "a little above full";
  EXPECT_EQ(gauge.Read(0.5F, kUnmeasured, kUnmeasured), 50);
}

TEST(BatteryGauge, KnowsWhoSaysPercentByMistake) {
  BatteryGauge gauge;
  EXPECT_EQ(gauge.Read(62.4F, kUnmeasured, kUnmeasured), 62);
  EXPECT_EQ(gauge.Read(100.0F, kUnmeasured, kUnmeasured), 100);
  EXPECT_EQ(gauge.Read(1.0F, kUnmeasured, kUnmeasured), 1) << "of 100, as it has shown";
}

TEST(BatteryGauge, TakesTheChargeWhereThereIsNoShare) {
  BatteryGauge gauge;
  EXPECT_EQ(gauge.Read(kUnmeasured, 2.0F, 8.0F), 25);
  EXPECT_EQ(gauge.Read(-1.0F, 2.0F, 8.0F), 25);
  EXPECT_EQ(gauge.Read(kUnmeasured, 9.0F, 8.0F), 100);
}

TEST(BatteryGauge, MakesNothingUp) {
  BatteryGauge gauge;
  EXPECT_EQ(gauge.Read(kUnmeasured, kUnmeasured, kUnmeasured), std::nullopt);
  EXPECT_EQ(gauge.Read(kEndless, kEndless, kEndless), std::nullopt);
  EXPECT_EQ(gauge.Read(-0.5F, -1.0F, 0.0F), std::nullopt);
  EXPECT_EQ(gauge.Read(7000.0F, 1.0F, 0.0F), std::nullopt);
  EXPECT_EQ(gauge.Read(kUnmeasured, 0.0F, 0.0F), std::nullopt);
}

}  // namespace
}  // namespace trailcast::motion
