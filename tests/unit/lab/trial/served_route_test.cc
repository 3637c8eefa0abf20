#include "services/lab/trial/src/served_route.h"

#include <gtest/gtest.h>

#include "services/route/digest.h"

namespace trailcast::trial {
namespace {

TaughtRoute RouteOf(std::uint32_t segments) {
  TaughtRoute taught;
  taught.info.key = {RouteId("00000000000000000000000000000000"), TeachingId(1)};
  taught.info.name = "hall";
  taught.info.scout = AgentId("scout");
  taught.info.camera = "webcam";
  taught.info.image_width_px = 320;
  taught.info.image_height_px = 240;
  for (std::uint32_t i = 0; i < segments; ++i) {
    route::Segment segment;
    segment.index = SegmentIndex(i);
    segment.has_odometry = true;
    segment.length_m = 1.0 + i;
    segment.duration_s = 2.0;
    taught.pieces.push_back(route::MakePiece(taught.info.key, segment));
    taught.info.length_m += segment.length_m;
    taught.info.bytes += taught.pieces.back().bytes.size();
  }
  taught.info.segment_count = segments;
  taught.info.state = route::RouteState::kComplete;
  return taught;
}

TEST(FetchFromServer, EverySegmentComesThroughInOrder) {
  const TaughtRoute taught = RouteOf(30);
  const auto fetched = FetchFromServer(taught);
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(fetched->pieces, taught.pieces);
  EXPECT_EQ(fetched->info.image_width_px, 320);
  EXPECT_EQ(fetched->info.state, route::RouteState::kComplete);
}

TEST(FetchFromServer, SaysWhenARouteDoesNotComeThrough) {
  TaughtRoute damaged = RouteOf(3);
  damaged.pieces[1].bytes[5] ^= 1U;  // the scout's copy went bad: no server takes it
  const auto fetched = FetchFromServer(damaged);
  ASSERT_FALSE(fetched);
  EXPECT_NE(fetched.error().message.find("did not come through"), std::string::npos)
      << fetched.error().message;
}

}  // namespace
}  // namespace trailcast::trial
