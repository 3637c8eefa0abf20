#include "services/lab/sim/core/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "services/base/angles.h"

namespace trailcast::sim {
namespace {

using ::testing::HasSubstr;

double BearingOf(const Eigen::Vector3d& direction) {
  return std::atan2(direction.x(), direction.z());
}

class BuiltInCamera : public ::testing::TestWithParam<std::string> {
 protected:
  const CameraModel camera_ = *FindCamera(GetParam());
  const Lens lens_{camera_};
  const Eigen::Vector2d middle_{(camera_.width - 1) / 2.0, (camera_.height - 1) / 2.0};
};

TEST_P(BuiltInCamera, IsValid) { EXPECT_TRUE(Validate(camera_)); }

TEST_P(BuiltInCamera, SeesEachPixelsDirectionInThatPixel) {
  int seen = 0;
  for (int y = 0; y < camera_.height; y += 7) {
    for (int x = 0; x < camera_.width; x += 7) {
      const auto direction = lens_.Direction({x, y});
      if (!direction) continue;
      ++seen;
      EXPECT_NEAR(direction->norm(), 1.0, 1e-9);
      const auto pixel = lens_.Project(3.0 * *direction);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), x, 1e-6);
      EXPECT_NEAR(pixel->y(), y, 1e-6);
    }
  }
  EXPECT_GT(seen, camera_.width * camera_.height / 49 / 2);
}

INSTANTIATE_TEST_SUITE_P(Set, BuiltInCamera,
                         ::testing::Values("webcam", "firewire", "wide", "hd", "fisheye", "omni"),
                         [](const auto& parameter) { return parameter.param; });

class CentralCamera : public BuiltInCamera {};

TEST_P(CentralCamera, LooksStraightAheadInItsMiddle) {
  const auto ahead = lens_.Direction(middle_);
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->z(), 1.0, 1e-12);
}

TEST_P(CentralCamera, SeesHalfItsFieldOfViewAtTheEdge) {
  const auto edge = lens_.Direction({camera_.width - 0.5, middle_.y()});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(Degrees(BearingOf(*edge)), camera_.horizontal_fov_deg / 2.0, 1e-6);
}

TEST_P(CentralCamera, IsSymmetricAndItsBearingGrowsFromLeftToRight) {
  double last = -std::numeric_limits<double>::infinity();
  for (int x = 0; x < camera_.width; ++x) {
    const auto direction = lens_.Direction({x, middle_.y()});
    const auto mirrored = lens_.Direction({camera_.width - 1.0 - x, middle_.y()});
    ASSERT_TRUE(direction && mirrored) << x;
    EXPECT_NEAR(BearingOf(*direction), -BearingOf(*mirrored), 1e-9);
    EXPECT_GT(BearingOf(*direction), last);
    last = BearingOf(*direction);
  }
}

INSTANTIATE_TEST_SUITE_P(Set, CentralCamera,
                         ::testing::Values("webcam", "firewire", "wide", "hd", "fisheye"),
                         [](const auto& parameter) { return parameter.param; });

TEST(Camera, BarrelDrawsTheEdgeInwards) {
  CameraModel straight = *FindCamera("webcam");
  straight.distortion = 0.0;
  CameraModel barrel = straight;
  barrel.distortion = 0.3;
  // The barrel shows the inner half of the same field of view larger.
  const Eigen::Vector3d inner(std::tan(Radians(15.0)), 0.0, 1.0);
  EXPECT_GT(Lens(barrel).Project(inner)->x(), Lens(straight).Project(inner)->x() + 1.0);
}

TEST(Camera, MirrorShowsAheadAtTheTopRightAtTheRightAndUpOutside) {
  const CameraModel camera = *FindCamera("omni");
  const Lens lens(camera);
  const auto ahead = lens.Project(Eigen::Vector3d::UnitZ());
  const auto right = lens.Project(Eigen::Vector3d::UnitX());
  const auto ahead_and_up = lens.Project({0.0, -0.2, 1.0});
  ASSERT_TRUE(ahead && right && ahead_and_up);
  EXPECT_NEAR(ahead->x(), 239.5, 1e-9);
  EXPECT_LT(ahead->y(), 120.0);
  EXPECT_NEAR(right->y(), 239.5, 1e-9);
  EXPECT_GT(right->x(), 360.0);
  EXPECT_LT(ahead_and_up->y(), ahead->y());
  EXPECT_FALSE(lens.Direction({239.5, 239.5}));
}

TEST(Camera, FisheyeIsBlackBeyondItsCircle) {
  const Lens lens(*FindCamera("fisheye"));
  EXPECT_TRUE(lens.Direction({239.5, 2.0}));
  EXPECT_FALSE(lens.Direction({2.0, 2.0}));
}

TEST(Camera, MountTurnsLeftAndUp) {
  const Eigen::Matrix3d level = BodyFromCamera(0.0, 0.0);
  EXPECT_TRUE((level * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE((level * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_GT((BodyFromCamera(0.1, 0.0) * Eigen::Vector3d::UnitZ()).y(), 0.09);
  EXPECT_GT((BodyFromCamera(0.0, 0.1) * Eigen::Vector3d::UnitZ()).z(), 0.09);
}

TEST(Camera, MountRollsClockwise) {
  const Eigen::Matrix3d rolled = BodyFromCamera(0.0, 0.0, Radians(90.0));
  EXPECT_TRUE((rolled * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  // Its picture's right side is below.
  EXPECT_TRUE((rolled * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Camera, TheLensMayLookBesideThePicturesMiddle) {
  CameraModel camera = *FindCamera("webcam");
  camera.centre_u = 0.05;
  camera.centre_v = -0.02;
  const auto ahead = Lens(camera).Project(Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->x(), 159.5 + 16.0, 1e-9);
  EXPECT_NEAR(ahead->y(), 119.5 - 6.4, 1e-9);
}

TEST(Camera, UnknownNameListsTheSet) {
  const auto camera = FindCamera("polaroid");
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(camera.error().message, HasSubstr("polaroid"));
  EXPECT_THAT(camera.error().message, HasSubstr("firewire"));
  EXPECT_FALSE(ParseLensModel("mirror"));
  EXPECT_EQ(*ParseLensModel("omni"), LensModel::kOmni);
}

TEST(Camera, ImpossibleValuesAreRefusedByTheirKey) {
  const auto refused_for = [](const char* key, auto change) {
    CameraModel camera = *FindCamera("webcam");
    change(camera);
    const auto valid = Validate(camera);
    ASSERT_FALSE(valid) << key;
    EXPECT_EQ(valid.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(valid.error().message, HasSubstr(key));
  };
  refused_for("width", [](CameraModel& c) { c.width = 0; });
  refused_for("roll_deg", [](CameraModel& c) { c.roll_deg = 270.0; });
  refused_for("ahead_m", [](CameraModel& c) { c.ahead_m = 3.0; });
  refused_for("centre_u", [](CameraModel& c) { c.centre_u = 0.5; });
  refused_for("centre_v", [](CameraModel& c) { c.centre_v = -0.5; });
  refused_for("knock_yaw_deg", [](CameraModel& c) { c.knock_yaw_deg = 90.0; });
  refused_for("knock_at_s", [](CameraModel& c) { c.knock_at_s = -1.0; });
  refused_for("exposure_swing", [](CameraModel& c) { c.exposure_swing = 0.5; });
  refused_for("readout_s", [](CameraModel& c) { c.readout_s = 0.5; });
  refused_for("exposure_period_s", [](CameraModel& c) { c.exposure_period_s = 0.0; });
  refused_for("height", [](CameraModel& c) { c.height = 100000; });
  refused_for("horizontal_fov_deg", [](CameraModel& c) { c.horizontal_fov_deg = 180.0; });
  refused_for("horizontal_fov_deg", [](CameraModel& c) { c.model = LensModel::kOmni; });
  refused_for("distortion", [](CameraModel& c) { c.distortion = 5.0; });
  refused_for("distortion", [](CameraModel& c) {
    c.horizontal_fov_deg = 110.0;
    c.distortion = -0.3;
  });
  refused_for("height_m", [](CameraModel& c) { c.height_m = -0.1; });
  refused_for("yaw_deg", [](CameraModel& c) { c.yaw_deg = std::nan(""); });
  refused_for("pitch_deg", [](CameraModel& c) { c.pitch_deg = 90.0; });
}

}  // namespace
}  // namespace trailcast::sim
