#include "services/route/src/seen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "services/route/codec.h"

namespace trailcast::route {
namespace {

using testing::HasSubstr;

constexpr std::int32_t kOutside = kMaxCoordinatePx * kStepsPerPixel + 1;

CodedFeature AFeature() { return {{}, {}, 0, {{0, 10, -10}, {kLastKnotTime, 20, -20}}}; }
CodedView AView(int at) { return {at, {}, {{Descriptor{1, 2, 3}, 64, 10, -10}}}; }

std::string ErrorOf(const Seen& seen) {
  const Result<Seen> read = Unpack(Pack(seen));
  if (read) return "accepted";
  EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
  return read.error().message;
}

TEST(Seen, NothingSeenTakesNoBytes) {
  EXPECT_EQ(Pack({}), "");
  const Result<Seen> read = Unpack("");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->features.empty());
}

TEST(Seen, FeaturesWithKnotsAtOtherTimesThanOthersComeBack) {
  Seen seen{{AFeature(), AFeature(), AFeature()}, {}};
  seen.features[1].track.insert(seen.features[1].track.begin() + 1, {100, -kOutside + 1, 5});
  const Result<Seen> read = Unpack(Pack(seen));
  ASSERT_TRUE(read) << read.error().message;
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(read->features[i].track.size(), seen.features[i].track.size()) << i;
    for (std::size_t k = 0; k < read->features[i].track.size(); ++k) {
      EXPECT_EQ(read->features[i].track[k].time, seen.features[i].track[k].time);
      EXPECT_EQ(read->features[i].track[k].u, seen.features[i].track[k].u);
      EXPECT_EQ(read->features[i].track[k].v, seen.features[i].track[k].v);
    }
  }
}

TEST(Seen, KnotsOutOfOrderOrTooManyAreRefused) {
  EXPECT_EQ(ErrorOf({{AFeature()}, {}}), "accepted");
  Seen seen{{AFeature(), AFeature()}, {}};
  seen.features[1].track.insert(seen.features[1].track.begin() + 1, {{9, 0, 0}, {9, 0, 0}});
  EXPECT_THAT(ErrorOf(seen), HasSubstr("feature 1: its knots are out of order"));
  seen.features[1] = AFeature();
  for (int time = 1; time < 64; ++time) {
    seen.features[1].track.insert(seen.features[1].track.end() - 1, {time, 0, 0});
  }
  EXPECT_THAT(ErrorOf(seen), HasSubstr("feature 1: it has more than 64 knots"));
}

TEST(Seen, CoordinatesOfNoCameraAreRefused) {
  for (const std::int32_t outside : {kOutside, -kOutside, (1 << 24) - 1}) {
    Seen seen{{AFeature(), AFeature()}, {AView(0), AView(0)}};
    seen.features[1].track[1].v = outside;
    EXPECT_THAT(ErrorOf(seen), HasSubstr("feature 1: it lies more than 65536 px"));
    seen.features[1] = AFeature();
    seen.views[1].features[0].u = outside;
    EXPECT_THAT(ErrorOf(seen), HasSubstr("key view 1: a feature lies more than 65536 px"));
  }
}

TEST(Seen, KeyViewsOutOfOrderOrBeyondTheSegmentAreRefused) {
  EXPECT_EQ(ErrorOf({{}, {AView(51), AView(51), AView(255)}}), "accepted");
  EXPECT_THAT(ErrorOf({{}, {AView(51), AView(50)}}), HasSubstr("key view 1: at 50 of 255"));
  EXPECT_THAT(ErrorOf({{}, {AView(51), AView(256)}}), HasSubstr("key view 1: at 256 of 255"));
}

TEST(Seen, MoreThanAllowedIsRefused) {
  EXPECT_THAT(ErrorOf({std::vector<CodedFeature>(1025, AFeature()), {}}),
              HasSubstr("1025 features, more than 1024"));
  EXPECT_THAT(ErrorOf({{}, std::vector<CodedView>(65, AView(0))}),
              HasSubstr("65 key views, more than 64"));
}

TEST(Seen, WhateverBytesAreReadAreRefusedOrComeBack) {
  std::mt19937 random(3);
  int read_ones = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = Pack({{AFeature(), AFeature()}, {AView(0), AView(3)}});
    char& byte = bytes[random() % bytes.size()];
    byte = static_cast<char>(static_cast<unsigned>(byte) ^ 1U << random() % 8U);
    const Result<Seen> read = Unpack(bytes);
    if (!read) continue;
    ++read_ones;
    ASSERT_TRUE(Unpack(Pack(*read)));
  }
  EXPECT_GT(read_ones, 0);
}

}  // namespace
}  // namespace trailcast::route
