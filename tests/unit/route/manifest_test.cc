#include "services/route/manifest.h"

#include <gtest/gtest.h>

#include "services/route/codec.h"
#include "services/route/digest.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

RouteInfo Begun() {
  RouteInfo info;
  info.key = {RouteId("0123456789abcdef0123456789abcdef"), TeachingId(3)};
  info.name = "yard";
  info.segment_count = 99;  // left over from elsewhere: not to be believed
  info.state = RouteState::kComplete;
  return info;
}

TEST(RouteBuilder, BeginsWithARouteOfNoSegments) {
  const RouteBuilder builder(Begun());
  EXPECT_EQ(builder.info().name, "yard");
  EXPECT_EQ(builder.info().segment_count, 0U);
  EXPECT_EQ(builder.info().state, RouteState::kTeaching);
  EXPECT_EQ(builder.info().manifest_digest, ManifestDigest({}));
}

TEST(RouteBuilder, CountsEverySegmentIn) {
  RouteBuilder builder(Begun());
  const SegmentPiece first = builder.Add(SampleSegment(0, 5));
  const SegmentPiece second = builder.Add(SampleSegment(1, 9));
  EXPECT_EQ(second.key, builder.info().key);
  EXPECT_EQ(second.bytes, Encode(SampleSegment(1, 9)));
  EXPECT_EQ(builder.info().segment_count, 2U);
  EXPECT_DOUBLE_EQ(builder.info().length_m, 2 * 3.0625);
  EXPECT_EQ(builder.info().bytes, first.bytes.size() + second.bytes.size());
  EXPECT_EQ(builder.info().manifest_digest,
            ManifestDigest(std::vector{first.digest, second.digest}));
  EXPECT_EQ(builder.info().state, RouteState::kTeaching);
  builder.Complete();
  EXPECT_EQ(builder.info().state, RouteState::kComplete);
}

TEST(RouteBuilder, CountsWhatWasEncodedBeforeLikeWhatItEncodes) {
  RouteBuilder whole(Begun());
  const SegmentPiece first = whole.Add(SampleSegment(0, 5));
  (void)whole.Add(SampleSegment(1, 9));
  RouteBuilder again(Begun());
  again.Add(first, SampleSegment(0, 5).length_m);
  (void)again.Add(SampleSegment(1, 9));
  EXPECT_EQ(again.info(), whole.info());
}

}  // namespace
}  // namespace trailcast::route
