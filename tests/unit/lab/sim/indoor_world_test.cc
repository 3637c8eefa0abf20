#include "services/lab/sim/places/indoor_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/lab/sim/core/camera_renderer.h"
#include "services/lab/sim/core/path_follow_driver.h"

namespace trailcast::sim {
namespace {

class IndoorWorld : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto made = MakeIndoorWorld();
    ASSERT_TRUE(made) << made.error().message;
    indoor_ = *made;
  }
  static void TearDownTestSuite() { indoor_ = {}; }
  static Place indoor_;
};
Place IndoorWorld::indoor_;

TEST_F(IndoorWorld, PathIsFifteenMetresLong) {
  EXPECT_NEAR(Length(indoor_.path.points), 15.0, 0.3);
}

TEST_F(IndoorWorld, PathKeepsHalfAMetreFromEverything) {
  const PathFollowDriver driver(indoor_.path.points);
  for (const Eigen::Vector2d& place : driver.path()) {
    for (const float height_m : {0.06F, 0.2F, 0.5F, 0.73F, 1.0F}) {
      for (int i = 0; i < 36; ++i) {
        const auto angle = static_cast<float>(i) * 0.17453F;
        const auto hit = indoor_.world->CastRay(
            {static_cast<float>(place.x()), static_cast<float>(place.y()), height_m},
            {std::cos(angle), std::sin(angle), 0.0F}, 0.5);
        ASSERT_FALSE(hit) << "at " << place.transpose() << " height " << height_m;
      }
    }
  }
}

// Furniture and walls, near and far, on either side of the way.
TEST_F(IndoorWorld, HasStructureAtManyDepthsOnBothSides) {
  const CameraModel camera = *FindCamera("webcam");
  CameraRenderer renderer(indoor_.world, camera);
  for (const double along_m : {0.5, 4.0, 8.0, 11.5}) {
    const Eigen::Vector2d at = PointAlong(indoor_.path.points, along_m);
    const Eigen::Vector2d ahead = PointAlong(indoor_.path.points, along_m + 0.3) - at;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(at.x(), at.y(), camera.height_m);
    pose.rotate(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Eigen::Vector3d::UnitZ()));
    pose.rotate(BodyFromCamera(0.0, 0.0));
    const PerfectView& view = renderer.Render(pose);
    for (const int first : {0, 160}) {
      constexpr std::size_t kPixels = 17'600;  // 110 rows of 160
      std::vector<float> depths;
      std::vector<float> grays;
      depths.reserve(kPixels);
      grays.reserve(kPixels);
      for (int y = 20; y < 130; ++y) {
        for (int x = first; x < first + 160; ++x) {
          depths.push_back(view.depth_m[image::PixelIndex(x, y, 320)]);
          grays.push_back(view.gray[image::PixelIndex(x, y, 320)]);
        }
      }
      std::sort(depths.begin(), depths.end());
      std::sort(grays.begin(), grays.end());
      const auto share = [](const std::vector<float>& v, std::size_t percent) {
        return v[v.size() * percent / 100];
      };
      EXPECT_GT(share(depths, 90) - share(depths, 10), 0.7F) << along_m << " " << first;
      EXPECT_GT(share(grays, 95) - share(grays, 5), 40.0F) << along_m << " " << first;
      EXPECT_LT(share(depths, 100 - 1), 20.0F);
    }
  }
}

TEST_F(IndoorWorld, IsTheSameEachTime) {
  const auto again = MakeIndoorWorld();
  ASSERT_TRUE(again);
  const auto& first = indoor_.world->surfaces();
  const auto& second = (*again).world->surfaces();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].shade[0], second[i].shade[0]) << i;
    ASSERT_EQ(first[i].normal, second[i].normal) << i;
  }
}

}  // namespace
}  // namespace trailcast::sim
