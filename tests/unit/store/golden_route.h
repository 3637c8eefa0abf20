#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "services/store/route_store.h"
#include "tests/support/taught_route.h"

namespace trailcast::store {

// The golden stores hold this route and a tombstone. It has labels and is cut off, and the first of
// its two segments is acknowledged.
[[nodiscard]] inline test::TaughtRoute GoldenRoute() {
  test::TaughtRoute taught = test::TeachSamples(2);
  taught.info.standing = route::Standing::kActive;
  taught.info.edition = 3;
  taught.info.description = "past the greenhouse";
  taught.info.cut_off = true;
  return taught;
}

[[nodiscard]] inline route::RouteInfo GoldenTombstone() {
  route::RouteInfo info = GoldenRoute().info;
  info.key.teaching = TeachingId(1);
  info.revision = RevisionNumber(1);
  info.standing = route::Standing::kDeleted;
  info.edition = 1;
  return info;
}

inline void FillWithGolden(RouteStore& store) {
  const test::TaughtRoute taught = GoldenRoute();
  ASSERT_TRUE(store.AppendSegments(taught.pieces));
  ASSERT_TRUE(store.PutRoute(taught.info));
  ASSERT_TRUE(store.MarkReceipted(taught.info.key, std::vector{SegmentIndex(0)}));
  ASSERT_TRUE(store.PutRoute(GoldenTombstone()));
}

inline void ExpectGolden(RouteStore& store) {
  const test::TaughtRoute taught = GoldenRoute();
  EXPECT_EQ(store.ListRoutes().value(), std::vector{taught.info});
  EXPECT_EQ(store.FindRoute(taught.info.key).value(), taught.info);
  EXPECT_EQ(store.FindRoute(GoldenTombstone().key).value(), GoldenTombstone());
  EXPECT_EQ(store.FindTeachings(taught.info.key.route).value().size(), 2U);
  EXPECT_EQ(store.QueryRoutes({.tags = {"night"}}).value().routes.size(), 1U);
  EXPECT_EQ(store.QueryRoutes({.near = {{*taught.info.place, 10.0}}}).value().routes.size(), 1U);
  for (const route::SegmentPiece& piece : taught.pieces) {
    EXPECT_EQ(store.ReadSegment(piece.key, piece.index).value(), piece);
    EXPECT_EQ(store.FindContent(piece.digest).value(), piece.bytes);
  }
  EXPECT_EQ(store.UnreceiptedSegments(taught.info.key).value(), std::vector{SegmentIndex(1)});
  EXPECT_THAT(store.Verify().value(), testing::IsEmpty());
}

}  // namespace trailcast::store
