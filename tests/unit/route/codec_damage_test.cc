#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "idl/route.pb.h"
#include "services/route/codec.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

using testing::HasSubstr;

// A small language for damage: a good message, changed by one line, must be refused and say why.
std::string ErrorAfter(const std::function<void(format::v1::Segment&)>& damage,
                       const Segment& sample = SampleSegment(5, 3, 3)) {
  const Bytes good = Encode(sample);
  format::v1::Segment message;
  EXPECT_TRUE(message.ParseFromArray(good.data(), static_cast<int>(good.size())));
  damage(message);
  Bytes bytes(message.ByteSizeLong());
  EXPECT_TRUE(message.SerializeToArray(bytes.data(), static_cast<int>(bytes.size())));
  const Result<Segment> decoded = Decode(bytes);
  if (decoded) return "accepted";
  EXPECT_EQ(decoded.error().code, ErrorCode::kCorrupt);
  return decoded.error().message;
}

TEST(CodecDamage, MessageLeftAsItIsIsAccepted) {
  EXPECT_EQ(ErrorAfter([](format::v1::Segment&) {}), "accepted");
}

TEST(CodecDamage, OtherFormatVersionIsRefusedWithWhatToDo) {
  EXPECT_THAT(ErrorAfter([](auto& m) { m.set_format_version(kFormatVersion + 1); }),
              HasSubstr("route format 5, this program reads format 4 alone: update it"));
  EXPECT_THAT(
      ErrorAfter([](auto& m) { m.set_format_version(kFormatVersion - 1); }),
      HasSubstr("route format 3, this program reads format 4 alone: teach the route again"));
  EXPECT_THAT(ErrorAfter([](auto& m) { m.clear_format_version(); }), HasSubstr("route format 0"));
}

TEST(CodecDamage, BytesOfWhatWasSeenThatAreTooManyOrTooFewAreRefused) {
  EXPECT_THAT(ErrorAfter([](auto& m) { m.mutable_seen()->append("more of it"); }),
              HasSubstr("takes more or less"));
  EXPECT_NE(ErrorAfter([](auto& m) { m.mutable_seen()->resize(m.seen().size() - 5); }), "accepted");
}

TEST(CodecDamage, TerrainOutOfBoundsIsRefused) {
  EXPECT_EQ(ErrorAfter([](auto& m) { m.mutable_terrain()->set_slope_mrad(-1571); }), "accepted");
  EXPECT_THAT(ErrorAfter([](auto& m) { m.mutable_terrain()->set_slope_mrad(-1572); }),
              HasSubstr("slopes -1572 mrad"));
  EXPECT_THAT(ErrorAfter([](auto& m) { m.mutable_terrain()->set_shake(10'001); }),
              HasSubstr("shakes 10001"));
  EXPECT_THAT(ErrorAfter([](auto& m) { m.mutable_terrain()->set_vertical_cm_per_s2(10'001); }),
              HasSubstr("10001 cm/s2"));
}

TEST(CodecDamage, DrivenBackwardsTakesOdometry) {
  const Segment sample = SampleSegmentDrivenBackwards(5, 3);
  EXPECT_EQ(ErrorAfter([](auto&) {}, sample), "accepted");
  EXPECT_THAT(ErrorAfter([](auto& m) { m.clear_odometry(); }, sample),
              HasSubstr("driven backwards, which takes odometry"));
}

TEST(CodecDamage, HeadingPolynomialThatIsNoneIsRefused) {
  EXPECT_THAT(
      ErrorAfter([](auto& m) { m.mutable_odometry()->set_heading_polynomial(1, std::nanf("")); }),
      HasSubstr("not finite"));
  EXPECT_THAT(ErrorAfter([](auto& m) { m.mutable_odometry()->add_heading_polynomial(0.0F); }),
              HasSubstr("4 coefficients, not 3"));
}

TEST(CodecDamage, OversizeBytesAreRefusedUnread) {
  const Result<Segment> decoded = Decode(Bytes(kMaxSegmentBytes + 1, 0));
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(decoded.error().message, HasSubstr("1048577 bytes is larger than 1048576"));
}

TEST(CodecDamage, NoBytesAreNoSegment) {
  const Result<Segment> decoded = Decode({});
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kCorrupt);
}

// A segment that decodes in spite of the damage must still keep every promise that a reader relies
// on.
void ExpectSane(const Result<Segment>& decoded) {
  if (!decoded) {
    EXPECT_EQ(decoded.error().code, ErrorCode::kCorrupt);
    EXPECT_FALSE(decoded.error().message.empty());
    return;
  }
  ASSERT_LE(decoded->features.size(), kMaxFeatures);
  for (const Feature& feature : decoded->features) {
    ASSERT_GE(feature.track.size(), 2U);
    ASSERT_LE(feature.track.size(), kMaxKnots);
    ASSERT_EQ(feature.first().s, 0.0F);
    ASSERT_EQ(feature.milestone().s, 1.0F);
    for (std::size_t k = 1; k < feature.track.size(); ++k) {
      ASSERT_LT(feature.track[k - 1].s, feature.track[k].s);
      ASSERT_LE(std::abs(feature.track[k].u_px), kMaxCoordinatePx);
    }
    for (const std::uint8_t sample : feature.patch) ASSERT_LE(sample, 15);
  }
}

TEST(CodecDamage, CutShortAnywhereIsRefused) {
  const Bytes good = Encode(SampleSegment(1, 4, 4));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
    const Result<Segment> decoded = Decode(cut);
    ExpectSane(decoded);
    // A cut before what was seen leaves a whole segment without features.
    EXPECT_TRUE(!decoded || decoded->features.empty()) << "cut to " << length;
  }
}

TEST(CodecDamage, EveryByteChangedEveryWayIsRefusedOrSane) {
  for (const Segment& segment : {SampleSegment(1, 2, 3), SampleSegmentWithKeyViews(1, 2)}) {
    const Bytes good = Encode(segment);
    Bytes bytes = good;
    for (std::size_t i = 0; i < good.size(); ++i) {
      for (unsigned value = 0; value < 256; ++value) {
        bytes[i] = static_cast<std::uint8_t>(value);
        ExpectSane(Decode(bytes));
      }
      bytes[i] = good[i];
    }
  }
}

TEST(CodecDamage, RandomBytesAreRefusedOrSane) {
  std::mt19937 random(20090401);
  const Bytes good = Encode(SampleSegment(1, 6, 3));
  for (int round = 0; round < 2000; ++round) {
    Bytes bytes = good;
    for (int change = 0; change < 8; ++change) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    if (round % 2 == 0) bytes.erase(bytes.begin(), bytes.begin() + random() % 100);
    ExpectSane(Decode(bytes));
  }
}

}  // namespace
}  // namespace trailcast::route
