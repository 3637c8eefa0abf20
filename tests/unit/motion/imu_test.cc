#include "services/motion/imu.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace trailcast::motion {
namespace {

// Turned to the left, then nose down, then right side down.
Attitude Turned(double left_rad, double down_rad, double right_rad) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(left_rad, Eigen::Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(down_rad, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(right_rad, Eigen::Vector3d::UnitX()));
  return {q.x(), q.y(), q.z(), q.w()};
}

TEST(Climb, IsHowFarTheNosePointsUpWhateverTheHeadingAndTheLean) {
  for (const double left_rad : {0.0, 1.0, 3.0, -2.0}) {
    for (const double right_rad : {0.0, 0.3, -0.2}) {
      EXPECT_NEAR(Climb(Turned(left_rad, -0.1, right_rad)).value(), 0.1, 1e-9);
      EXPECT_NEAR(Climb(Turned(left_rad, 0.25, right_rad)).value(), -0.25, 1e-9);
    }
  }
}

TEST(Climb, OfAQuaternionOfAnyLengthIsTheSameAndOfNoneIsNothing) {
  EXPECT_NEAR(Climb({0.0, -2.0 * std::sin(0.05), 0.0, 2.0 * std::cos(0.05)}).value(), 0.1, 1e-9);
  EXPECT_FALSE(Climb({0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(Climb({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0}));
}

}  // namespace
}  // namespace trailcast::motion
