#include "services/view/any_camera.h"

#include <gtest/gtest.h>

#include "tests/support/seen_segment.h"

namespace trailcast::view {
namespace {

using test::Seeing;
using test::SegmentToSee;
using test::ViewOf;

// Returns a segment of one key view with features of 1 to 2 pixels.
route::Segment Taught(unsigned number) {
  route::Segment segment;
  segment.key_views.push_back({0.0, ViewOf(SegmentToSee(number, 0), {.flipped_bits = 0})});
  route::View& features = segment.key_views.front().features;
  for (std::size_t i = 0; i < features.size(); ++i) {
    features[i].size_px = 1.0F + 0.25F * static_cast<float>(i % 5);
  }
  return segment;
}

// By a camera that sees all so many times as large; what else is in its picture reaches `edge_px`.
route::View SeenBy(float scale, const Seeing& seeing = {}, float edge_px = 160.0F) {
  route::View view = ViewOf(SegmentToSee(1, 0), seeing);
  const route::View taught = Taught(1).key_views.front().features;
  for (std::size_t i = 0; i < view.size(); ++i) {
    view[i].u_px *= scale;
    view[i].v_px *= scale;
    view[i].size_px = scale * taught[i].size_px;
  }
  route::ViewFeature edge;
  edge.descriptor.fill(1);
  edge.u_px = edge_px;
  edge.size_px = 1.0F;
  view.push_back(edge);
  return view;
}

TEST(AnyCameraView, FindsAPlaceByCamerasFromAFifthToThreeTimesTheMagnification) {
  for (const float scale : {0.26F, 0.35F, 0.45F, 0.7F, 1.0F, 1.4F, 2.5F}) {
    const ViewMatch match = AnyCameraView(SeenBy(scale)).MatchWith(Taught(1));
    EXPECT_TRUE(match.found()) << scale;
    EXPECT_GE(match.agreed, 20) << scale;
  }
}

TEST(AnyCameraView, StrangersHaveNothingInCommon) {
  const ViewMatch match = AnyCameraView(SeenBy(1.0F)).MatchWith(Taught(2));
  EXPECT_FALSE(match.found());
  EXPECT_EQ(match.score(), 0.0);
}

TEST(AnyCameraView, TheSameFeaturesInAnotherArrangementAreNotThePlace) {
  EXPECT_FALSE(AnyCameraView(SeenBy(0.5F, {.shuffled = true})).MatchWith(Taught(1)).found());
}

TEST(AnyCameraView, FeaturesThatAreNotAsLargeAsTheMagnificationSaysAreOthers) {
  route::View view = SeenBy(0.5F);
  for (route::ViewFeature& feature : view) feature.size_px *= 2.0F;
  EXPECT_FALSE(AnyCameraView(view).MatchWith(Taught(1)).found());
}

TEST(AnyCameraView, OfWhatHasNoSizesTheMagnificationMayBeLessFarOff) {
  route::View view = SeenBy(0.7F);
  for (route::ViewFeature& feature : view) feature.size_px = 0.0F;
  EXPECT_TRUE(AnyCameraView(view).MatchWith(Taught(1)).found());
  route::Segment old = Taught(1);
  for (route::ViewFeature& feature : old.key_views.front().features) feature.size_px = 0.0F;
  EXPECT_TRUE(AnyCameraView(SeenBy(0.7F)).MatchWith(old).found());
}

TEST(AnyCameraView, EmptyViewsAndSegmentsMatchNothing) {
  EXPECT_FALSE(AnyCameraView({}).MatchWith(Taught(1)).found());
  EXPECT_FALSE(AnyCameraView(SeenBy(1.0F)).MatchWith(route::Segment{}).found());
}

}  // namespace
}  // namespace trailcast::view
