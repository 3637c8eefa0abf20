#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "services/base/angles.h"
#include "services/lab/sim/core/camera_renderer.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "services/lab/sim/core/robot.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {
namespace {

struct Expected {
  const char* name;
  double length_m;
  double clear_m;  // free on either side of the way, at the height of bumpers
  std::size_t most_triangles;
  GroundMode ground;
  double tilt_deg = 0.0;  // that the robot reaches somewhere on the way
};

std::ostream& operator<<(std::ostream& out, const Expected& expected) {
  return out << expected.name;
}

const std::vector<Expected> kExpected = {
    {"indoor", 15.0, 0.5, 60'000, GroundMode::kFlat},
    {"paved", 60.0, 0.6, 150'000, GroundMode::kFlat},
    {"rough", 40.0, 0.6, 150'000, GroundMode::kMesh, 4.0},
    {"desks", 10.0, 0.5, 60'000, GroundMode::kFlat},
    {"loop", 380.0, 0.6, 300'000, GroundMode::kFlat},
    {"ramp", 40.0, 0.6, 150'000, GroundMode::kMesh, 3.5},
    {"road", 80.0, 0.6, 150'000, GroundMode::kFlat},
    {"turns", 25.0, 0.5, 60'000, GroundMode::kFlat},
    {"corridor", 30.0, 0.5, 60'000, GroundMode::kFlat},
    {"dead-end", 18.0, 0.5, 60'000, GroundMode::kFlat},
    {"parking-place", 22.0, 0.5, 150'000, GroundMode::kFlat},
    {"field", 30.0, 20.0, 150'000, GroundMode::kFlat},
    {"rows", 53.0, 0.5, 250'000, GroundMode::kFlat},
};

// A robot as drawn that is set down along the place's way, on the ground there.
class Walk {
 public:
  explicit Walk(const Place& place)
      : path_(PathFollowDriver(place.path.points).path()),
        start_(StartPose(path_)),
        floor_m_(place.world->FloorHeight(start_.x_m, start_.y_m)),
        robot_(place.world, {}, {}, start_, floor_m_.value_or(0.0) + 1e-3, 1) {}

  [[nodiscard]] bool has_floor() const { return floor_m_.has_value(); }
  // The body's pose every `step_m`, in order.
  [[nodiscard]] std::vector<Eigen::Isometry3d> Poses(double step_m) {
    std::vector<Eigen::Isometry3d> poses;
    for (double along_m = 0.0; along_m < Length(path_) - 0.1; along_m += step_m) {
      const Eigen::Vector2d at = PointAlong(path_, along_m);
      const Eigen::Vector2d ahead = PointAlong(path_, along_m + 0.1) - at;
      robot_.PlaceAt({at.x(), at.y(), std::atan2(ahead.y(), ahead.x())});
      poses.push_back(robot_.WorldFromBody());
    }
    return poses;
  }

 private:
  Polyline path_;
  motion::Pose2 start_;
  std::optional<double> floor_m_;
  DifferentialDriveRobot robot_;
};

double TiltRad(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d& r = pose.linear();
  return std::max(std::abs(std::asin(r(2, 0))), std::abs(std::asin(r(2, 1))));
}

// Returns what a camera at the path's start sees.
std::vector<float> FirstPicture(const Place& place) {
  CameraRenderer renderer(place.world, *FindCamera("webcam"));
  const auto poses = Walk(place).Poses(1e9);
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.translation().z() = 0.35;
  mount.linear() = BodyFromCamera(0.0, 0.0);
  return renderer.Render(poses.front() * mount).gray;
}

Place Open(const std::string& name) {
  PlaceOptions options;
  options.world = name;
  auto place = OpenPlace(options);
  EXPECT_TRUE(place) << place.error().message;
  return place ? *place : Place();
}

class BuiltIn : public ::testing::TestWithParam<Expected> {};

// One test a place, as making it is what takes the time.
TEST_P(BuiltIn, CanBeDrivenThroughAndIsTheSameEachTime) {
  const Expected& expected = GetParam();
  const Place place = Open(expected.name);
  ASSERT_NE(place.world, nullptr);
  EXPECT_EQ(place.world->ground(), expected.ground);
  EXPECT_LE(place.world->surfaces().size(), expected.most_triangles);
  EXPECT_NEAR(Length(PathFollowDriver(place.path.points).path()), expected.length_m,
              0.1 * expected.length_m);
  EXPECT_TRUE(DescribePlace(expected.name));
  EXPECT_EQ(FirstPicture(place), FirstPicture(Open(expected.name)));

  Walk walk(place);
  ASSERT_TRUE(walk.has_floor());
  double largest_tilt_rad = 0.0;
  constexpr int kRays = 24;
  for (const Eigen::Isometry3d& pose : walk.Poses(0.25)) {
    const Eigen::Vector3d at = pose.translation();
    ASSERT_TRUE(place.world->GroundHeight(at.x(), at.y(), at.z() + 0.15)) << at.transpose();
    largest_tilt_rad = std::max(largest_tilt_rad, TiltRad(pose));
    for (const double height_m : {0.12, 0.30, 0.6}) {
      for (int i = 0; i < kRays; ++i) {
        const double angle = Radians(360.0) * i / kRays;
        const Eigen::Vector3d from = at + Eigen::Vector3d(0.0, 0.0, height_m);
        const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
        const auto hit =
            place.world->CastRay(from.cast<float>(), direction.cast<float>(), expected.clear_m);
        ASSERT_FALSE(hit && std::abs(hit->normal.z()) < 0.6F) << from.transpose();
      }
    }
  }
  EXPECT_LE(largest_tilt_rad, Radians(6.0));
  EXPECT_GE(largest_tilt_rad, Radians(expected.tilt_deg));
}

INSTANTIATE_TEST_SUITE_P(Places, BuiltIn, ::testing::ValuesIn(kExpected), [](const auto& each) {
  std::string name = each.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(BuiltInPlaces, AreAllInTheTableAbove) {
  std::vector<std::string> names;
  names.reserve(std::size(kExpected));
  for (const Expected& each : kExpected) names.emplace_back(each.name);
  EXPECT_EQ(BuiltInPlaces(), names);
  EXPECT_FALSE(DescribePlace("moon"));
}

}  // namespace
}  // namespace trailcast::sim
