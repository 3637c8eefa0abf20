#include "services/lab/sim/core/path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temp_dir.h"

namespace trailcast::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const Polyline kCorner = {{0, 0}, {4, 0}, {4, 3}};

Result<DrivenPath> Read(const std::string& text) {
  const trailcast::test::TempDir folder;
  std::ofstream(folder / "path.csv") << text;
  return ReadPath(folder / "path.csv");
}

TEST(Path, WayPointsAreReadWithAndWithoutHeight) {
  const auto plain = Read("x_m,y_m\n1.5,-2\r\n\n3, 4\n");
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_THAT(plain->points,
              ::testing::ElementsAre(Eigen::Vector2d(1.5, -2), Eigen::Vector2d(3, 4)));
  EXPECT_FALSE(plain->z_max_m);
  const auto high = Read("x_m,y_m,z_m\n0,0,1.2\n1,0,9\n");
  ASSERT_TRUE(high);
  EXPECT_EQ(high->z_max_m, 1.2);
}

TEST(Path, BadLinesAreNamedByFileAndNumber) {
  const auto refused = [](const std::string& text, const char* line, const char* what) {
    const auto path = Read(text);
    ASSERT_FALSE(path) << text;
    EXPECT_THAT(path.error().message,
                AllOf(HasSubstr("path.csv"), HasSubstr(line), HasSubstr(what)));
  };
  refused("x,y\n0,0\n1,1\n", "line 1", "header");
  refused("x_m,y_m\n0,0\n1,east\n", "line 3", "east");
  refused("x_m,y_m\n0,0,0\n1,1\n", "line 2", "columns");
  refused("x_m,y_m\n0,0\n1,nan\n", "line 3", "nan");
  refused("x_m,y_m\n1,1\n1,1\n", "1 way-points", "at least two");
  refused("", "line 1", "header");
  EXPECT_EQ(ReadPath("/nowhere/path.csv").error().code, ErrorCode::kNotFound);
}

TEST(Path, APathTooLongToBeHeldInMemoryIsRefused) {
  EXPECT_TRUE(Read("x_m,y_m\n0,0\n10000,0\n"));
  for (const char* far : {"10000.1", "44444444444444444", "1e300"}) {
    const auto path = Read(std::string("x_m,y_m\n0,0\n") + far + ",1\n");
    ASSERT_FALSE(path) << far;
    EXPECT_THAT(path.error().message, AllOf(HasSubstr("path.csv"), HasSubstr("10000 m")));
  }
}

TEST(Path, LengthAndPointsAlong) {
  EXPECT_DOUBLE_EQ(Length(kCorner), 7.0);
  EXPECT_TRUE(PointAlong(kCorner, 5.0).isApprox(Eigen::Vector2d(4, 1)));
  EXPECT_TRUE(PointAlong(kCorner, -1.0).isApprox(Eigen::Vector2d(0, 0)));
  EXPECT_TRUE(PointAlong(kCorner, 99.0).isApprox(Eigen::Vector2d(4, 3)));
  const Polyline points = {{1, 1}, {1, 2}};
  EXPECT_NEAR(StartPose(points).heading_rad, 1.5708, 1e-4);
  EXPECT_NEAR(StartPose(DrivenPath{points, {}, Gear::kForwards}).heading_rad, 1.5708, 1e-4);
  EXPECT_NEAR(StartPose(DrivenPath{points, {}, Gear::kBackwards}).heading_rad, -1.5708, 1e-4);
}

TEST(Path, NearestPlaceIsSignedToTheLeft) {
  const PlaceOnPath left = Nearest(kCorner, {1.0, 0.5});
  EXPECT_DOUBLE_EQ(left.distance_m, 0.5);
  EXPECT_DOUBLE_EQ(left.along_m, 1.0);
  EXPECT_DOUBLE_EQ(left.left_m, 0.5);
  EXPECT_DOUBLE_EQ(Nearest(kCorner, {1.0, -0.5}).left_m, -0.5);
  EXPECT_DOUBLE_EQ(Nearest(kCorner, {4.0, 5.0}).distance_m, 2.0);
}

TEST(Path, NearestPlaceStaysWithinTheStretchAskedFor) {
  // A path that comes back beside itself.
  const Polyline hairpin = {{0, 0}, {5, 0}, {5, 0.2}, {0, 0.2}};
  const PlaceOnPath out = Nearest(hairpin, {2.0, 0.19}, 0.0, 4.0);
  EXPECT_NEAR(out.along_m, 2.0, 1e-9);
  EXPECT_NEAR(Nearest(hairpin, {2.0, 0.19}).along_m, 8.2, 1e-9);
}

TEST(Path, RoundedCornersKeepTheEndsAndCutTheCorner) {
  const Polyline rounded = RoundCorners(kCorner, 0.6, 0.02);
  EXPECT_TRUE(rounded.front().isApprox(kCorner.front()));
  EXPECT_TRUE(rounded.back().isApprox(kCorner.back()));
  EXPECT_LT(Length(rounded), 7.0);
  EXPECT_GT(Length(rounded), 6.6);
  EXPECT_GT(Nearest(rounded, {4, 0}).distance_m, 0.1);
  EXPECT_LT(Nearest(rounded, {4, 0}).distance_m, 0.4);
}

}  // namespace
}  // namespace trailcast::sim
