#include "route_server/routes/refresh_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "services/refresh/successor.h"
#include "services/route/codec.h"
#include "tests/support/memory_store.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::server {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint32_t kSegments = 3;

class RefreshWatchTest : public testing::Test {
 protected:
  RefreshWatchTest() { followed_ = Keep(1, route::Standing::kActive, Taught()); }

  static std::vector<route::Segment> Taught() {
    std::vector<route::Segment> segments;
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      segments.push_back(route::SampleSegmentWithKeyViews(i, 20));
    }
    return segments;
  }
  // Keeps a revision of one route.
  route::RouteInfo Keep(unsigned revision, route::Standing standing,
                        const std::vector<route::Segment>& segments, unsigned refreshes = 0) {
    route::RouteKey key = test::KeyNumber(1);
    key.teaching = TeachingId(revision);
    for (const route::Segment& segment : segments) {
      route::SegmentPiece piece{
          .key = key, .index = segment.index, .digest = {}, .bytes = route::Encode(segment)};
      piece.digest = test::ToyDigest(piece.bytes);
      EXPECT_TRUE(store_.AppendSegments({&piece, 1}));
    }
    route::RouteInfo info = test::InfoOf(key, {}, route::RouteState::kComplete);
    info.revision = RevisionNumber(revision);
    info.standing = standing;
    info.segment_count = static_cast<std::uint32_t>(segments.size());
    info.refreshes = RevisionNumber(refreshes);
    info.description = "xyzzy";
    if (refreshes > 0) info.tags = {std::string(refresh::kTag)};
    EXPECT_TRUE(store_.PutRoute(info));
    return info;
  }
  // Which says that it refreshes that revision.
  route::RouteInfo Deliver(const std::vector<route::Segment>& segments, unsigned of = 1,
                           unsigned revision = 7) {
    return Keep(revision, route::Standing::kStaged, segments, of);
  }
  std::vector<RefreshWatch::Judged> Judge(const route::RouteInfo& info) {
    watch_.Note(info);
    return Judge();
  }
  std::vector<RefreshWatch::Judged> Judge() {
    for (int i = 0; i < 20; ++i) {
      const auto more = watch_.Step();
      EXPECT_TRUE(more) << more.error().message;
      if (!more || !*more) break;
    }
    return watch_.TakeJudged();
  }

  test::MemoryStore store_;
  RefreshWatch watch_{store_};
  route::RouteInfo followed_;
};

TEST_F(RefreshWatchTest, WhatIsTheFollowedOneWithAFewOtherFeaturesMayTakeItsPlace) {
  auto segments = Taught();
  segments[1].features.erase(segments[1].features.begin());
  const auto judged = Judge(Deliver(segments));
  ASSERT_THAT(judged, SizeIs(1));
  EXPECT_EQ(judged.front().why_not, "");
  EXPECT_EQ(judged.front().info.revision.value(), 7U);
}

TEST_F(RefreshWatchTest, WhatCameBeforeTheServerWasStoppedIsLookedAtWhenItStartsAgain) {
  auto segments = Taught();
  segments[1].features.erase(segments[1].features.begin());
  Deliver(segments);
  Deliver(segments, 4, 8);  // of one that is not followed, which was told when it came
  ASSERT_TRUE(watch_.NoteStored());
  const auto judged = Judge();
  ASSERT_THAT(judged, SizeIs(1));
  EXPECT_EQ(judged.front().info.revision.value(), 7U);
  EXPECT_EQ(judged.front().why_not, "");
}

TEST_F(RefreshWatchTest, WhatLeadsElsewhereMayNot) {
  auto segments = Taught();
  segments[2].heading.c[1] = 0.25;
  const auto judged = Judge(Deliver(segments));
  ASSERT_THAT(judged, SizeIs(1));
  EXPECT_THAT(judged.front().why_not, HasSubstr("in segment 2 it is not revision 1"));
}

TEST_F(RefreshWatchTest, NorWhatEndsElsewhere) {
  route::RouteInfo info = Deliver(Taught());
  info.segment_count = 2;
  EXPECT_THAT(Judge(info).front().why_not, HasSubstr("other segments than revision 1"));
}

TEST_F(RefreshWatchTest, NorOneOfARevisionThatIsNotFollowed) {
  const auto judged = Judge(Deliver(Taught(), 4));
  ASSERT_THAT(judged, SizeIs(1));
  EXPECT_THAT(judged.front().why_not,
              HasSubstr("refreshes revision 4, which robots do not follow"));
}

TEST_F(RefreshWatchTest, WhatAsksForALookOrIsNoRefreshIsNotCompared) {
  route::RouteInfo info = Deliver(Taught());
  info.to_review = true;
  EXPECT_THAT(Judge(info), IsEmpty());
  info.to_review = false;
  info.edition = 2;  // it was active, and somebody has rolled back
  EXPECT_THAT(Judge(info), IsEmpty());
  info.edition = 0;
  info.refreshes = {};
  EXPECT_THAT(Judge(info), IsEmpty());
  info = Deliver(Taught());
  info.standing = route::Standing::kActive;
  EXPECT_THAT(Judge(info), IsEmpty());
}

TEST_F(RefreshWatchTest, ASegmentThatIsNotThereIsTheStoresError) {
  route::RouteInfo info = Deliver({});
  info.segment_count = kSegments;
  watch_.Note(info);
  EXPECT_TRUE(watch_.Step());
  EXPECT_FALSE(watch_.Step());
  EXPECT_EQ(watch_.Step().value_or(true), false) << "it is left as it is";
  EXPECT_THAT(watch_.TakeJudged(), IsEmpty());
}

}  // namespace
}  // namespace trailcast::server
