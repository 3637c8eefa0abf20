// Files that were damaged on their way, and files made to deceive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "services/archive/route_file.h"
#include "services/route/codec.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/archive/made_file.h"

namespace trailcast::archive {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string ErrorOf(const route::Bytes& bytes) {
  const auto file = RouteFile::Open(std::span<const std::uint8_t>(bytes));
  if (file) return "accepted";
  EXPECT_EQ(file.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(file.error().message, HasSubstr("route file in memory"));
  return file.error().message;
}

route::Bytes Whole() { return MadeFile::Of(test::TeachSamples(2)).Bytes(); }

// Returns what is said of the route with one thing changed. Sizes and checksum are made right.
std::string ErrorAfter(const std::function<void(MadeFile&)>& change) {
  MadeFile made = MadeFile::Of(test::TeachSamples(2));
  change(made);
  return ErrorOf(made.Bytes());
}
std::string ErrorAfterInfo(const std::function<void(route::RouteInfo&)>& change) {
  test::TaughtRoute taught = test::TeachSamples(2);
  change(taught.info);
  return ErrorOf(MadeFile::Of(taught).Bytes());
}

// A segment's frame of whatever bytes, with the right digest, counted in nowhere.
void Replace(MadeFile::Frame& frame, const route::Bytes& bytes) {
  frame.size = static_cast<std::uint32_t>(bytes.size());
  frame.bytes = bytes;
  frame.digest = route::Sha256(bytes);
}

TEST(RouteFileDamage, AWholeFileIsAccepted) { EXPECT_EQ(ErrorOf(Whole()), "accepted"); }

TEST(RouteFileDamage, EveryBitFlippedIsFound) {
  route::Bytes bytes = Whole();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      bytes[i] ^= static_cast<std::uint8_t>(1U << bit);
      ASSERT_NE(ErrorOf(bytes), "accepted") << "byte " << i << " bit " << bit;
      bytes[i] ^= static_cast<std::uint8_t>(1U << bit);
    }
  }
}

TEST(RouteFileDamage, CutShortAnywhereIsFound) {
  const route::Bytes bytes = Whole();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const route::Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    // Less than the magic cannot be told from another kind of file.
    EXPECT_THAT(ErrorOf(cut), HasSubstr(length < 8 ? "is no route file" : "cut short")) << length;
  }
}

TEST(RouteFileDamage, AnotherKindOfFileIsToldByItsBeginning) {
  EXPECT_THAT(ErrorOf({'P', 'K', 3, 4, 0, 0, 0, 0, 0}),
              AllOf(HasSubstr("begins with [50 4b 03 04 00 00 00 00]"),
                    HasSubstr("expected [54 52 43 52 4f 55 54 45] (\"TRCROUTE\")")));
  EXPECT_THAT(ErrorOf({}), HasSubstr("begins with []"));
}

TEST(RouteFileDamage, AnotherVersionIsNamed) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.version = 3; }),
              HasSubstr("version 3, this program reads 2 alone: update it"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.version = 1; }),
              HasSubstr("version 1, this program reads 2 alone: teach the route again"));
}

TEST(RouteFileDamage, BytesAfterTheEndAreRefused) {
  route::Bytes bytes = Whole();
  const std::string size = std::to_string(bytes.size());
  bytes.push_back(0);
  EXPECT_THAT(ErrorOf(bytes), AllOf(HasSubstr("goes on after its end"), HasSubstr(size)));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) {
                made.rest = {1, 2, 3};
              }),
              HasSubstr("3 bytes follow its last segment, expected none"));
}

TEST(RouteFileDamage, AWrongChecksumIsTold) {
  route::Bytes bytes = Whole();
  bytes.back() ^= 1U;
  EXPECT_THAT(ErrorOf(bytes), AllOf(HasSubstr("is damaged"), HasSubstr("expected")));
}

TEST(RouteFileDamage, ADescriptionThatIsNoneIsRefused) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.description = {}; }),
              HasSubstr("description of the route has 0 bytes, expected 1 to 16384"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.description.resize(16385); }),
              HasSubstr("has 16385 bytes"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) {
                made.description = {0xff, 0xff, 0xff};
              }),
              HasSubstr("3 bytes are no route's description"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) {
                made.description = {0x10, 1};
              }),
              HasSubstr("manifest digest has 0 bytes, expected 32"));
}

TEST(RouteFileDamage, ARouteThatIsBeingTaughtIsRefused) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) {
                route::RouteInfo info = test::TeachSamples(2).info;
                info.state = route::RouteState::kTeaching;
                made.description = route::EncodeInfo(info);
              }),
              HasSubstr("still being taught"));
}

TEST(RouteFileDamage, SizesThatCannotBeAreRefusedUnread) {
  // The description would reach into the checksum, or far beyond the file.
  for (const std::uint32_t size : {64U, 16384U}) {
    MadeFile small;
    small.description = {0x10, 1};
    route::Bytes bytes = small.Bytes();
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[kInfoSizeAt + i] = static_cast<std::uint8_t>(size >> (8U * i));
    }
    EXPECT_THAT(ErrorOf(bytes), HasSubstr("too few for the")) << size;
  }
  route::Bytes bytes = Whole();
  std::fill_n(bytes.begin() + kFileSizeAt, 8, 0xff);
  EXPECT_THAT(ErrorOf(bytes), HasSubstr("expected 18446744073709551615"));
}

TEST(RouteFileDamage, FieldsOutOfBoundsAreNamed) {
  const auto error = ErrorAfterInfo;
  EXPECT_THAT(error([](auto& info) { info.name = "../../etc/passwd"; }),
              HasSubstr("route name \"../../etc/passwd\" is not a name"));
  EXPECT_THAT(error([](auto& info) { info.name.clear(); }), HasSubstr("route name"));
  EXPECT_THAT(error([](auto& info) { info.scout = AgentId(std::string(65, 'a')); }),
              HasSubstr("scout"));
  EXPECT_THAT(error([](auto& info) { info.key.route = RouteId("x"); }), HasSubstr("route id"));
  EXPECT_THAT(error([](auto& info) { info.key.teaching = TeachingId(1ULL << 63U); }),
              HasSubstr("teaching"));
  EXPECT_THAT(error([](auto& info) { info.camera = "\033[2J"; }), HasSubstr("camera"));
  EXPECT_THAT(error([](auto& info) { info.image_width_px = 70000; }), HasSubstr("image width"));
  EXPECT_THAT(error([](auto& info) { info.image_height_px = -1; }), HasSubstr("image height"));
  EXPECT_THAT(error([](auto& info) { info.length_m = -1.0; }), HasSubstr("route length"));
  EXPECT_THAT(error([](auto& info) { info.length_m = std::nan(""); }), HasSubstr("route length"));
  EXPECT_THAT(error([](auto& info) { info.tags = {"b", "a"}; }), HasSubstr("not sorted"));
  EXPECT_THAT(error([](auto& info) { info.tags.assign(17, "a"); }), HasSubstr("tags is 17"));
  EXPECT_THAT(error([](auto& info) { info.place->y = 91.0; }), HasSubstr("latitude"));
  EXPECT_THAT(error([](auto& info) { info.place->frame = route::Place::Frame{0}; }),
              HasSubstr("place frame is 0"));
}

TEST(RouteFileDamage, CountsThatCannotBeAreRefused) {
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.segment_count = 0; }),
              HasSubstr("it says that it has 0 segments"));
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.segment_count = 100'000; }),
              HasSubstr("it says that it has 100000 segments, expected 1 to the"));
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.segment_count = 0xffffffff; }),
              HasSubstr("segment count is 4294967295, at most 100000"));
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.segment_count = 3; }),
              HasSubstr("segment 2 is missing: 0 bytes are left"));
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.segment_count = 1; }),
              HasSubstr("follow its last segment"));
  EXPECT_THAT(ErrorAfterInfo([](auto& info) { info.bytes += 1; }), HasSubstr("bytes together"));
}

TEST(RouteFileDamage, ASegmentsSizeIsNotBelieved) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.frames[1].size = 0xffffffff; }),
              HasSubstr("segment 1 has 4294967295 bytes, expected 1 to"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.frames[0].size = 0; }),
              HasSubstr("segment 0 has 0 bytes"));
  EXPECT_THAT(
      ErrorAfter([](MadeFile& made) { Replace(made.frames[0], route::Bytes((1U << 20U) + 1)); }),
      HasSubstr("segment 0 has 1048577 bytes, expected 1 to 1048576"));
}

TEST(RouteFileDamage, SegmentsOutOfOrderAreRefused) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { std::swap(made.frames[0], made.frames[1]); }),
              HasSubstr("out of order: found segment 1, expected 0"));
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.frames[1].index = 0; }),
              HasSubstr("found segment 0, expected 1"));
}

TEST(RouteFileDamage, ASegmentOfOtherBytesThanItsDigestIsNamed) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { made.frames[1].bytes[3] ^= 1U; }),
              AllOf(HasSubstr("segment 1 of teaching 2 of route"), HasSubstr("have digest")));
}

TEST(RouteFileDamage, ASegmentThatDoesNotDecodeIsNamed) {
  EXPECT_THAT(
      ErrorAfter([](MadeFile& made) {
        Replace(made.frames[1], {0xff, 0xff});
      }),
      AllOf(HasSubstr("segment 1 of teaching 2 of route"), HasSubstr("2 bytes are no segment")));
  // Another's segment, with its own digest.
  EXPECT_THAT(ErrorAfter([](MadeFile& made) { Replace(made.frames[1], made.frames[0].bytes); }),
              HasSubstr("its bytes are of segment 0"));
}

TEST(RouteFileDamage, SegmentsThatAreNotOfTheManifestAreRefused) {
  EXPECT_THAT(ErrorAfter([](MadeFile& made) {
                route::Segment other = route::SampleSegment(1, 1, 2);
                other.length_m += 1.0;
                Replace(made.frames[1], route::Encode(other));
              }),
              HasSubstr("not those of its manifest"));
}

TEST(RouteFileDamage, WhatALaterWriterAddsToTheDescriptionIsSkipped) {
  // Field 100, a number, which this version does not know.
  EXPECT_EQ(ErrorAfter([](MadeFile& made) {
              made.description.insert(made.description.end(), {0xa0, 0x06, 0x01});
            }),
            "accepted");
}

TEST(RouteFileDamage, RandomChangesUnderARightChecksumNeverCrash) {
  std::mt19937 random(20090401);
  const route::Bytes good = Whole();
  std::size_t refused = 0;
  for (int round = 0; round < 3000; ++round) {
    route::Bytes bytes = good;
    const std::size_t end = bytes.size() - kChecksumBytes;
    for (int change = 0; change < 3; ++change) {
      bytes[kPreambleBytes + random() % (end - kPreambleBytes)] =
          static_cast<std::uint8_t>(random());
    }
    const route::Digest checksum = route::Sha256({bytes.data(), end});
    std::copy(checksum.begin(), checksum.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end));
    refused += ErrorOf(bytes) != "accepted" ? 1U : 0U;
  }
  EXPECT_GT(refused, 1000U);
}

TEST(RouteFileDamage, AFileOfAbsurdSizeIsRefusedUnread) {
  const test::TempDir folder;
  WriteFile(folder / "big.trailcast", Whole());
  std::filesystem::resize_file(folder / "big.trailcast", kMaxFileBytes + 1);  // sparse
  const auto file = RouteFile::Open(folder / "big.trailcast");
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().message, HasSubstr("has 1073741825 bytes, a route file at most"));
}

}  // namespace
}  // namespace trailcast::archive
