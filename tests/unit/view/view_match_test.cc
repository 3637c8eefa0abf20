#include "services/view/view_match.h"

#include <gtest/gtest.h>

#include "tests/support/seen_segment.h"

namespace trailcast::view {
namespace {

using test::SegmentToSee;
using test::ViewOf;

TEST(ViewMatch, TheSameFeaturesInTheSameArrangementAgree) {
  const route::Segment segment = SegmentToSee(1, 0);
  const ViewMatch match = Match(ViewOf(segment), segment);
  EXPECT_TRUE(match.found());
  EXPECT_GE(match.agreed, 25);
  EXPECT_GT(match.score(), 0.6);
}

TEST(ViewMatch, TheEndOfASegmentIsFoundByItsMilestone) {
  const route::Segment segment = SegmentToSee(1, 0);
  route::View view = ViewOf(segment, {.shift_u_px = 0.0F, .shift_v_px = 0.0F});
  for (std::size_t i = 0; i < view.size(); ++i) {
    view[i].u_px = segment.features[i].milestone().u_px;
    view[i].v_px = segment.features[i].milestone().v_px;
  }
  EXPECT_GT(Match(view, segment).likeness, 0.9 * static_cast<double>(view.size()));
}

TEST(ViewMatch, StrangersHaveNothingInCommon) {
  const ViewMatch match = Match(ViewOf(SegmentToSee(1, 0)), SegmentToSee(2, 0));
  EXPECT_FALSE(match.found());
  EXPECT_EQ(match.score(), 0.0);
}

TEST(ViewMatch, TheSameFeaturesInAnotherArrangementDoNotAgree) {
  const route::Segment segment = SegmentToSee(1, 0);
  EXPECT_FALSE(Match(ViewOf(segment, {.shuffled = true}), segment).found());
}

// Near things have moved to the side against far ones.
TEST(ViewMatch, APlaceSeenFromAsideIsLessLikeIt) {
  const route::Segment segment = SegmentToSee(1, 0);
  route::View aside = ViewOf(segment);
  for (std::size_t i = 0; i < aside.size(); i += 2) aside[i].u_px *= 0.95F;
  const ViewMatch match = Match(aside, segment);
  EXPECT_TRUE(match.found());
  EXPECT_LT(match.score(), Match(ViewOf(segment), segment).score());
}

TEST(ViewMatch, OneFeatureThatAllOthersLookLikeCountsOnce) {
  route::Segment segment = SegmentToSee(1, 0);
  for (route::Feature& feature : segment.features) {
    feature = segment.features.front();
  }
  EXPECT_FALSE(Match(ViewOf(SegmentToSee(1, 0)), segment).found());
}

TEST(ViewMatch, EmptyViewsAndSegmentsMatchNothing) {
  EXPECT_FALSE(Match({}, SegmentToSee(1, 0)).found());
  EXPECT_FALSE(Match(ViewOf(SegmentToSee(1, 0)), route::Segment{}).found());
}

}  // namespace
}  // namespace trailcast::view
