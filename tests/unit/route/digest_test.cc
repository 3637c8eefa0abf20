#include "services/route/digest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/base/hex.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const RouteKey kKey{RouteId("0123456789abcdef0123456789abcdef"), TeachingId(2)};

// The three examples of FIPS 180's SHA-256.
TEST(Digest, IsSha256) {
  EXPECT_EQ(ToHex(Sha256({})), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const Bytes abc{'a', 'b', 'c'};
  EXPECT_EQ(ToHex(Sha256(abc)), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(ToHex(Sha256(Bytes(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, OfAStreamIsThatOfItsPiecesTogether) {
  Sha256Stream stream;
  stream.Add(Bytes{'a'});
  stream.Add({});
  stream.Add(Bytes{'b', 'c'});
  EXPECT_EQ(stream.Finish(), Sha256(Bytes{'a', 'b', 'c'}));
}

TEST(Digest, OfAManifestIsTheDigestOfTheDigestsInARow) {
  const std::vector<Digest> digests{Sha256({}), Sha256(Bytes{'a', 'b', 'c'})};
  Bytes row(digests[0].begin(), digests[0].end());
  row.insert(row.end(), digests[1].begin(), digests[1].end());
  EXPECT_EQ(ManifestDigest(digests), Sha256(row));
  EXPECT_NE(ManifestDigest(digests), ManifestDigest(std::vector{digests[1], digests[0]}));
  EXPECT_EQ(ManifestDigest({}), Sha256({}));
}

TEST(Piece, OpensToTheSegmentItWasMadeOf) {
  const Segment segment = SampleSegment(12, 20);
  const SegmentPiece piece = MakePiece(kKey, segment);
  EXPECT_EQ(piece.key, kKey);
  EXPECT_EQ(piece.index, SegmentIndex(12));
  ASSERT_TRUE(CheckDigest(piece));
  const Result<Segment> opened = Open(piece);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(*opened, segment);
}

TEST(Piece, WithAChangedByteIsCorruptAndSaysWhichSegment) {
  SegmentPiece piece = MakePiece(kKey, SampleSegment(12, 20));
  piece.bytes[100] ^= 1U;
  const Result<Segment> opened = Open(piece);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(opened.error().message, AllOf(HasSubstr("segment 12"), HasSubstr(kKey.route.value()),
                                            HasSubstr("teaching 2"), HasSubstr("digest")));
}

TEST(Piece, OfAnotherSegmentsBytesIsCorrupt) {
  SegmentPiece piece = MakePiece(kKey, SampleSegment(12, 20));
  piece.index = SegmentIndex(13);
  const Result<Segment> opened = Open(piece);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(opened.error().message, HasSubstr("its bytes are of segment 12"));
}

TEST(Piece, WithARightDigestOfNonsenseIsCorrupt) {
  SegmentPiece piece{kKey, SegmentIndex(1), {}, {'h', 'e', 'l', 'l', 'o'}};
  piece.digest = Sha256(piece.bytes);
  const Result<Segment> opened = Open(piece);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(opened.error().message, HasSubstr("segment 1 of teaching 2 of route"));
}

}  // namespace
}  // namespace trailcast::route
