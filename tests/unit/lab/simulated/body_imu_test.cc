#include "services/lab/simulated/body_imu.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::agent {
namespace {

constexpr double kStep_s = 1.0 / 50.0;

Eigen::Isometry3d Body(double ahead_m, double up_m, double climb_rad) {
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
  body.translation() = Eigen::Vector3d(ahead_m, 0.0, up_m);
  body.rotate(Eigen::AngleAxisd(-climb_rad, Eigen::Vector3d::UnitY()));
  return body;
}

TEST(BodyImu, OfABodyThatStandsOnASlopeFeelsGravityAlone) {
  BodyImu imu;
  motion::ImuSample felt;
  for (int i = 0; i < 5; ++i) felt = imu.Feel(FromSeconds(i * kStep_s), Body(1.0, 2.0, 0.1));
  ASSERT_TRUE(felt.acceleration_mps2 && felt.attitude);
  EXPECT_NEAR(felt.acceleration_mps2->x(), 9.81 * std::sin(0.1), 1e-9);
  EXPECT_NEAR(felt.acceleration_mps2->z(), 9.81 * std::cos(0.1), 1e-9);
  EXPECT_NEAR(motion::Climb(*felt.attitude).value(), 0.1, 1e-9);
}

TEST(BodyImu, FeelsHowItIsShakenUpAndDown) {
  BodyImu imu;
  const auto felt_at = [&](int i) {
    const double up_m = 0.01 * std::sin(2.0 * 3.14159265 * i * kStep_s);
    return imu.Feel(FromSeconds(i * kStep_s), Body(0.0, up_m, 0.0)).acceleration_mps2->z() - 9.81;
  };
  double most = 0.0;
  for (int i = 0; i < 100; ++i) most = std::max(most, felt_at(i));
  EXPECT_NEAR(most, 0.01 * std::pow(2.0 * 3.14159265, 2), 0.01);
}

}  // namespace
}  // namespace trailcast::agent
