#include "services/replay/passing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::replay {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;

// 0.6 m wide with its margin, and 0.3 m to its front.
class PassingTest : public testing::Test {
 protected:
  PassingTest() { Make(0.8); }
  void Make(double most_m) {
    PassingOptions options;
    options.most_m = most_m;
    options.robot = {0.3, 0.3};
    passing_.emplace(options);
  }
  // A straight path so far, or one that bends to the left.
  static PathAhead Path(double length_m = 3.6, double curvature_per_m = 0.0) {
    PathAhead path{{0.0, 0.0}};
    for (int i = 1; i <= std::lround(length_m / Passing::kApart_m); ++i) {
      const double heading_rad = (i - 0.5) * Passing::kApart_m * curvature_per_m;
      path.emplace_back(path.back() +
                        Passing::kApart_m * Vector2d(std::cos(heading_rad), std::sin(heading_rad)));
    }
    return path;
  }
  // Returns what stands between two sides of the path, so far along it, as seen by a robot on the
  // path.
  static std::vector<Vector2d> Cart(double along_m, double right_m, double left_m) {
    std::vector<Vector2d> points;
    for (double y_m = right_m; y_m <= left_m + 1e-9; y_m += 0.05) points.emplace_back(along_m, y_m);
    return points;
  }
  void Look(const std::vector<Vector2d>& stands) {
    passing_->Look(offset_, route_m_, true, path_, stands);
  }

  std::optional<Passing> passing_;
  PathOffset offset_{0.0, 0.0, 0.0, 0.02};
  double route_m_ = 5.0;
  PathAhead path_ = Path();
};

TEST_F(PassingTest, StaysOnAPathThatIsFree) {
  Look({});
  EXPECT_EQ(passing_->left_m(), 0.0);
  Look({{2.0, 0.35}, {1.0, -0.35}});
  EXPECT_EQ(passing_->left_m(), 0.0) << "what stands beside it";
  EXPECT_EQ(passing_->says(), "");
}

TEST_F(PassingTest, GoesRoundByTheShorterWayAndComesBack) {
  // On the right half of the path: 0.1 m to the left of it is its edge.
  Look(Cart(2.4, -0.5, 0.1));
  EXPECT_NEAR(passing_->left_m(), 0.1 + 0.3 + 0.1 + 0.05, 0.051);
  EXPECT_THAT(passing_->says(), HasSubstr("passes what stands on the path, 0.5"));
  EXPECT_THAT(passing_->says(), HasSubstr("to the left"));
  const double left_m = passing_->left_m();
  const std::string says = passing_->says();
  offset_.left_m = left_m;
  route_m_ += 1.5;
  Look(Cart(0.9, -0.5 - left_m, 0.1 - left_m));
  EXPECT_EQ(passing_->left_m(), left_m);
  EXPECT_EQ(passing_->says(), says);
  // Out of its scanner's view, beside it.
  route_m_ += 1.1;
  Look({});
  EXPECT_EQ(passing_->left_m(), left_m);
  route_m_ += 0.6;
  Look({});
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_EQ(passing_->says(), "");
}

TEST_F(PassingTest, GoesToTheSideWithRoom) {
  std::vector<Vector2d> stands = Cart(2.4, -0.5, 0.1);
  const std::vector<Vector2d> wall = Cart(2.6, 0.6, 1.5);
  stands.insert(stands.end(), wall.begin(), wall.end());
  Make(1.2);
  Look(stands);
  EXPECT_LT(passing_->left_m(), -0.85);
  EXPECT_THAT(passing_->says(), HasSubstr("to the right"));
}

TEST_F(PassingTest, WithoutRoomItStaysOnThePathAndSaysSo) {
  Look(Cart(2.4, -1.5, 1.5));
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_EQ(passing_->says(),
            "something stands on the path, and within 0.8 m neither side has room to pass it");
  Look({});
  EXPECT_EQ(passing_->says(), "") << "it is gone";
}

TEST_F(PassingTest, NoFurtherThanItMay) {
  Make(0.4);
  Look(Cart(2.4, -0.5, 0.1));
  EXPECT_EQ(passing_->left_m(), 0.0);
  Make(0.0);
  Look(Cart(2.4, -0.5, 0.1));
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_EQ(passing_->says(), "");
}

TEST_F(PassingTest, NotWithoutBeingSureOfItsPlace) {
  offset_.left_sigma_m = 0.2;
  Look(Cart(2.4, -0.5, 0.1));
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_THAT(passing_->says(), HasSubstr("not sure enough of its place"));
  offset_.left_sigma_m = 0.02;
  passing_->Look(offset_, route_m_, false, path_, Cart(2.4, -0.5, 0.1));
  EXPECT_EQ(passing_->left_m(), 0.0);
}

TEST_F(PassingTest, NotWhereThePathEndsBehindIt) {
  path_ = Path(2.8);
  Look(Cart(2.0, -0.5, 0.1));
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_THAT(passing_->says(), HasSubstr("too near where the robot is to stand"));
}

// Or it would end there beside the path, and say that it has arrived.
TEST_F(PassingTest, WhoPassesOneThingComesBackBeforeTheNextAtThePathsEnd) {
  Look(Cart(2.0, -0.5, 0.1));
  const double left_m = passing_->left_m();
  ASSERT_GT(left_m, 0.0);
  // A second one comes into view where the path ends, on its other side as well.
  offset_.left_m = left_m;
  route_m_ += 1.0;
  path_ = Path(2.4);
  std::vector<Vector2d> both = Cart(1.0, -0.5 - left_m, 0.1 - left_m);
  for (const Vector2d& point : Cart(2.4, -0.5 - left_m, 0.1 - left_m)) both.push_back(point);
  Look(both);
  EXPECT_EQ(passing_->left_m(), left_m);
  // Past the first.
  route_m_ += 1.7;
  path_ = Path(0.7);
  Look(Cart(0.7, -0.5 - left_m, 0.1 - left_m));
  EXPECT_EQ(passing_->left_m(), 0.0);
  EXPECT_THAT(passing_->says(), HasSubstr("too near where the robot is to stand"));
}

TEST_F(PassingTest, LooksAlongABend) {
  path_ = Path(3.6, 0.5);
  Look(Cart(2.4, -0.3, 0.3));
  EXPECT_EQ(passing_->left_m(), 0.0) << "straight ahead, where the path does not go";
  // A radius of 2 m: 2 m along it.
  const Vector2d there(2.0 * std::sin(1.0), 2.0 - 2.0 * std::cos(1.0));
  Look({there});
  EXPECT_NE(passing_->left_m(), 0.0);
}

TEST_F(PassingTest, SeesFromWhereTheRobotIsBesideThePath) {
  offset_.left_m = 0.2;
  offset_.heading_rad = 0.1;
  // Two metres along the path, in its middle, as seen from there.
  const double cos = std::cos(0.1);
  const double sin = std::sin(0.1);
  Look({{2.0 * cos - 0.2 * sin, -2.0 * sin - 0.2 * cos}});
  EXPECT_NE(passing_->left_m(), 0.0);
  EXPECT_NEAR(std::abs(passing_->left_m()), 0.45, 0.051);
}

TEST_F(PassingTest, WhatIsBesideTheRobotNowIsNotDrivenInto) {
  std::vector<Vector2d> stands = Cart(2.4, -0.5, 0.1);
  // A post beside it on the left.
  stands.emplace_back(0.2, 0.6);
  Make(1.2);
  Look(stands);
  EXPECT_LT(passing_->left_m(), 0.0);
}

TEST_F(PassingTest, ARobotThatIsFoundElsewhereIsBackOnThePath) {
  Look(Cart(2.4, -0.5, 0.1));
  ASSERT_GT(passing_->left_m(), 0.0);
  route_m_ = 60.0;
  Look({});
  EXPECT_EQ(passing_->left_m(), 0.0);
}

}  // namespace
}  // namespace trailcast::replay
