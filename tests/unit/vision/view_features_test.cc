#include "services/vision/view_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/walk_frames.h"

namespace trailcast::vision {
namespace {

TEST(DescribeView, GivesDescribedFeaturesInsideThePictureAndNoMoreThanAViewMayHave) {
  const image::GrayImage frame = test::WalkFrame(40, 640, 480);
  const route::View view = DescribeView(frame);
  EXPECT_GT(view.size(), 100U);
  EXPECT_LE(view.size(), route::kMaxViewFeatures);
  for (const route::ViewFeature& feature : view) {
    EXPECT_TRUE(route::IsDescribed(feature.descriptor));
    EXPECT_LT(std::abs(feature.u_px), 320.0F);
    EXPECT_LT(std::abs(feature.v_px), 240.0F);
  }
  EXPECT_EQ(view, DescribeView(frame));
}

TEST(DescribeView, SeesNothingInABlankPicture) {
  EXPECT_TRUE(
      DescribeView({160, 120, std::vector<std::uint8_t>(std::size_t{160} * 120, 90)}).empty());
}

}  // namespace
}  // namespace trailcast::vision
