#include "services/route/codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

// Its bytes, which say what it is.
Bytes ThereAndBack(const Segment& segment) {
  Bytes bytes = Encode(segment);
  const Result<Segment> decoded = Decode(bytes);
  if (decoded) {
    EXPECT_EQ(*decoded, segment);
  } else {
    ADD_FAILURE() << decoded.error().message;
  }
  return bytes;
}

TEST(Codec, SegmentOnTheGridComesBackUnchanged) {
  for (const int knots : {2, 3, 4, 17, static_cast<int>(kMaxKnots)}) {
    const Segment segment = SampleSegment(7, 40, knots);
    const Result<Segment> decoded = Decode(Encode(segment));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(*decoded, segment) << knots << " knots";
  }
}

TEST(Codec, KeyViewsAndTheTurnBeforeComeBackUnchanged) {
  const Segment segment = SampleSegmentWithKeyViews(7, 40);
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, segment);
}

TEST(Codec, TerrainComesBackUnchangedEachPartOnItsOwnAndTakesAFewBytes) {
  for (const Terrain& terrain :
       {Terrain{}, Terrain{0.0, {}, {}}, Terrain{{}, 0.0, {}}, Terrain{{}, {}, 0.0},
        Terrain{0.0123, {}, {}}, Terrain{0.0071, 1.23, -0.087}, Terrain{1.0, 100.0, 1.571}}) {
    Segment segment = SampleSegment(7, 3);
    const std::size_t without = Encode(segment).size();
    segment.terrain = terrain;
    const Bytes bytes = ThereAndBack(segment);
    EXPECT_LE(bytes.size() - without, terrain.known() ? 11U : 0U);
  }
}

TEST(Codec, HowOftenFeaturesWereMissedComesBackAndTakesNoByteWhereNoneWas) {
  Segment segment = SampleSegmentWithKeyViews(7, 40);
  const std::size_t without = Encode(segment).size();
  segment.features[3].missed = 2;
  segment.features[39].missed = 255;
  const Bytes bytes = ThereAndBack(segment);
  EXPECT_LE(bytes.size(), without + 20);
}

TEST(Codec, AKeyViewThatAFollowerAddedComesBackAsOne) {
  Segment segment = SampleSegmentWithKeyViews(7, 5);
  const std::size_t without = Encode(segment).size();
  segment.key_views[1].missed = 0;
  segment.key_views[3].missed = 255;
  const Bytes bytes = ThereAndBack(segment);
  EXPECT_LE(bytes.size(), without + 3);
}

TEST(Codec, TerrainOfARobotGoneMadIsHeldWithinBounds) {
  Segment segment = SampleSegment(7, 3);
  segment.terrain = {-1.0, 1e9, -1e9};
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(decoded->terrain, (Terrain{0.0, 100.0, -1.571}));
}

TEST(Codec, WhatAKeyViewSharesWithOneBeforeItTakesFewBytes) {
  Segment segment = SampleSegmentWithKeyViews(7, 40);
  const std::size_t with = Encode(segment).size();
  segment.key_views.pop_back();
  EXPECT_LE(with - Encode(segment).size(), 40U * 16U);
}

TEST(Codec, SegmentWithoutFeaturesOrOdometryComesBackUnchanged) {
  Segment segment;
  segment.index = SegmentIndex(4294967295U);
  segment.duration_s = 2.5;
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, segment);
}

TEST(Codec, TheWayBySightComesBackWithoutOdometry) {
  Segment segment = SampleSegment(7, 3);
  segment.has_odometry = false;
  segment.length_m = segment.heading_change_rad = segment.heading_variation_rad = 0.0;
  segment.heading = {};
  const std::size_t without = Encode(segment).size();
  segment.seen_way = SeenWay{0.75, {{0.25, -0.5, 0.125}}};
  EXPECT_EQ(ThereAndBack(segment).size(), without + 19U);
}

TEST(Codec, LargestNumbersComeBackUnchanged) {
  Segment segment;
  segment.has_odometry = true;
  segment.duration_s = std::numeric_limits<std::uint32_t>::max() / 1e3;
  segment.length_m = std::numeric_limits<std::int32_t>::max() / 1e4;
  segment.heading_change_rad = std::numeric_limits<std::int32_t>::lowest() / 1e5;
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, segment);
}

TEST(Codec, WithoutOdometryNoneOfItsNumbersTravel) {
  Segment segment = SampleSegment(0, 1);
  segment.has_odometry = false;
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded);
  EXPECT_FALSE(decoded->has_odometry);
  EXPECT_EQ(decoded->length_m, 0.0);
  EXPECT_EQ(decoded->heading, HeadingPolynomial{});
  EXPECT_EQ(decoded->duration_s, segment.duration_s);
}

TEST(Codec, NumbersBetweenTheStepsAreRoundedToTheNearest) {
  Segment segment = SampleSegment(0, 1, 2);
  segment.length_m = 1.23456789;
  segment.heading_change_rad = -0.123456789;
  segment.heading_variation_rad = 0.987654321;
  segment.duration_s = 1.2345678;
  segment.features[0].track = {{0.0F, 10.04F, -10.04F}, {0.3001F, -33.33F, 33.33F}, {1.0F, 0, 0}};
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded);
  EXPECT_NEAR(decoded->length_m, segment.length_m, 0.00005);
  EXPECT_NEAR(decoded->heading_change_rad, segment.heading_change_rad, 0.000005);
  EXPECT_NEAR(decoded->heading_variation_rad, segment.heading_variation_rad, 0.000005);
  EXPECT_NEAR(decoded->duration_s, segment.duration_s, 0.0005);
  ASSERT_EQ(decoded->features[0].track.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const TrackKnot& taught = segment.features[0].track[k];
    const TrackKnot& read = decoded->features[0].track[k];
    EXPECT_NEAR(read.s, taught.s, 0.5 / 255.0) << k;
    EXPECT_NEAR(read.u_px, taught.u_px, 0.5 / 16.0) << k;
    EXPECT_NEAR(read.v_px, taught.v_px, 0.5 / 16.0) << k;
  }
}

TEST(Codec, RoundingErrorsDoNotAddUpAlongATrack) {
  Segment segment = SampleSegment(0, 1, 2);
  segment.features[0].track.clear();
  for (int k = 0; k < 50; ++k) {
    const float s = static_cast<float>(k) / 49.0F;
    segment.features[0].track.push_back({s, 0.03F * static_cast<float>(k), 20.01F});
  }
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded);
  ASSERT_EQ(decoded->features[0].track.size(), 50U);
  EXPECT_NEAR(decoded->features[0].milestone().u_px, 0.03F * 49.0F, 0.5 / 16.0);
}

TEST(Codec, KnotThatRoundsOntoItsNeighbourIsLeftOut) {
  Segment segment = SampleSegment(0, 1, 2);
  segment.features[0].track = {{0.0F, 0, 0},    {0.001F, 1, 1}, {0.5F, 2, 2},
                               {0.5005F, 3, 3}, {0.999F, 4, 4}, {1.0F, 5, 5}};
  const Result<Segment> decoded = Decode(Encode(segment));
  ASSERT_TRUE(decoded) << decoded.error().message;
  const TrackKnot first{0.0F, 0, 0};
  const TrackKnot middle{128.0F / 255.0F, 2, 2};
  const TrackKnot milestone{1.0F, 5, 5};
  EXPECT_THAT(decoded->features[0].track, testing::ElementsAre(first, middle, milestone));
}

TEST(Codec, EqualSegmentsGiveEqualBytesAndDecodingThenEncodingGivesThemAgain) {
  const Bytes bytes = Encode(SampleSegment(3, 25, 4));
  EXPECT_EQ(bytes, Encode(SampleSegment(3, 25, 4)));
  const Result<Segment> decoded = Decode(bytes);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(Encode(*decoded), bytes);
}

// Where four fields of two greys meet, so far to the right and down.
Patch Corner(unsigned right, unsigned down) {
  Patch patch{};
  for (unsigned i = 0; i < patch.size(); ++i) {
    patch.at(i) = (i % kPatchSize < right) == (i / kPatchSize < down) ? 11 : 5;
  }
  return patch;
}

TEST(Codec, APlainPatternTakesFewBytesAndNoiseNoMoreThanItsSamples) {
  Segment segment = SampleSegment(7, 100, 2);
  const std::size_t noisy = Encode(segment).size();
  EXPECT_LT(noisy, 100U * (61 + 5 + 33 + 4));
  for (unsigned i = 0; i < segment.features.size(); ++i) {
    segment.features[i].patch = Corner(3 + i % 5, 3 + i % 6);
  }
  EXPECT_LT(ThereAndBack(segment).size(), noisy - 100 * 35);
}

}  // namespace
}  // namespace trailcast::route
