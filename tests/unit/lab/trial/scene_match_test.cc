#include "services/lab/trial/align/src/scene_match.h"

#include <gtest/gtest.h>

#include "services/lab/trial/align/src/camera_mask.h"
#include "services/lab/trial/align/src/feature_file.h"
#include "tests/support/painted_wall.h"

namespace trailcast::trial {
namespace {

using test::PaintedWall;

SceneFeatures Seen(const PaintedWall& wall, PaintedWall::View view = {}) {
  return FindSceneFeatures(wall.Photograph(view), {});
}

TEST(SceneMatch, TheSameSceneAgreesAndAnotherDoesNot) {
  const PaintedWall wall(1);
  const SceneMatch same = MatchScenes(Seen(wall), Seen(wall, {.noise_grey = 3, .noise_seed = 2}));
  EXPECT_GT(same.inliers, 40);
  EXPECT_NEAR(same.median_du_px, 0.0, 0.3);
  EXPECT_LT(MatchScenes(Seen(wall), Seen(PaintedWall(2))).inliers, 15);
}

TEST(SceneMatch, APictureAgreesWithItselfToTheLastFeature) {
  const SceneFeatures seen = Seen(PaintedWall(1));
  const SceneMatch match = MatchScenes(seen, seen);
  EXPECT_GT(match.inliers, static_cast<int>(seen.features.size()) * 8 / 10);
  EXPECT_EQ(match.median_du_px, 0.0);
}

TEST(SceneMatch, FurtherRightInTheReplaysPictureIsPositive) {
  const PaintedWall wall(1);
  EXPECT_NEAR(MatchScenes(Seen(wall), Seen(wall, {.du_px = 12.0})).median_du_px, 12.0, 0.5);
  EXPECT_NEAR(MatchScenes(Seen(wall), Seen(wall, {.du_px = -12.0})).median_du_px, -12.0, 0.5);
}

TEST(SceneMatch, HoldsUnderOtherLightAndMagnification) {
  const PaintedWall wall(1);
  const SceneMatch match =
      MatchScenes(Seen(wall), Seen(wall, {.scale = 1.3, .du_px = 8.0, .gain = 0.6}));
  EXPECT_GT(match.inliers, 25);
  EXPECT_GT(match.median_du_px, 0.0);
}

TEST(SceneMatch, PixelsAreTheReplaysWhereSizesDiffer) {
  const PaintedWall wall(1);
  const SceneFeatures half = Seen(wall, {.scale = 0.5, .du_px = 6.0, .width = 160, .height = 120});
  EXPECT_NEAR(MatchScenes(Seen(wall), half).median_du_px, 6.0, 0.5);
  EXPECT_NEAR(MatchScenes(half, Seen(wall)).median_du_px, -12.0, 1.0);
}

TEST(SceneMatch, NothingMatchesABlankPicture) {
  const image::GrayImage blank{160, 120, std::vector<std::uint8_t>(19200, 90)};
  const SceneFeatures nothing = FindSceneFeatures(blank, {});
  EXPECT_TRUE(nothing.features.empty());
  EXPECT_EQ(MatchScenes(nothing, Seen(PaintedWall(1))).inliers, 0);
  EXPECT_EQ(MatchScenes(Seen(PaintedWall(1)), nothing).inliers, 0);
}

TEST(SceneFeatures, AreNotWhereTheCameraSeesItself) {
  image::GrayImage mask{320, 240, std::vector<std::uint8_t>(76800, 255)};
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 160; ++x) mask.pixels[image::PixelIndex(x, y, 320)] = 0;
  }
  const SceneFeatures seen = FindSceneFeatures(PaintedWall(1).Photograph({}), mask);
  ASSERT_FALSE(seen.features.empty());
  for (const SceneFeature& feature : seen.features) EXPECT_GE(feature.x_px, 158.0F);
}

TEST(FeatureFile, GivesBackWhatWasPutIn) {
  auto file = FeatureFile::Make();
  ASSERT_TRUE(file) << file.error().message;
  const SceneFeatures first = Seen(PaintedWall(1));
  const SceneFeatures second = Seen(PaintedWall(2), {.width = 200, .height = 100});
  ASSERT_TRUE(file->Append(first));
  ASSERT_TRUE(file->Append({64, {}}));
  ASSERT_TRUE(file->Append(second));
  ASSERT_EQ(file->size(), 3U);
  const auto back = file->Read(2);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->width_px, 200);
  ASSERT_EQ(back->features.size(), second.features.size());
  for (std::size_t i = 0; i < second.features.size(); ++i) {
    EXPECT_EQ(back->features[i].x_px, second.features[i].x_px);
    EXPECT_EQ(back->features[i].descriptor, second.features[i].descriptor);
  }
  EXPECT_TRUE(file->Read(1)->features.empty());
  EXPECT_EQ(file->Read(0)->features.size(), first.features.size());
}

}  // namespace
}  // namespace trailcast::trial
