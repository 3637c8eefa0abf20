#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "services/base/hex.h"
#include "services/route/codec.h"
#include "services/route/digest.h"
#include "tests/support/places.h"
#include "tests/unit/route/sample_segment.h"

namespace trailcast::route {
namespace {

const std::filesystem::path kGolden = std::filesystem::path(SourceDir()) / "tests/golden";
const std::filesystem::path kFile = kGolden / "segment-v4.bin";
const std::filesystem::path kFileWithKeyViews = kGolden / "segment-v4-key-views.bin";
const std::filesystem::path kFileDrivenBackwards = kGolden / "segment-v4-backwards.bin";

Bytes ReadFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void Write(const std::filesystem::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
}

class Golden : public testing::Test {
 protected:
  void SetUp() override {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread runs here.
    if (std::getenv("TRAILCAST_WRITE_GOLDEN") == nullptr) return;
    Write(kFile, Encode(SampleSegment(42, 3, 4)));
    Write(kFileWithKeyViews, Encode(SampleSegmentWithKeyViews(42, 3)));
    Write(kFileDrivenBackwards, Encode(SampleSegmentDrivenBackwards(42, 3)));
    GTEST_SKIP() << "wrote " << kFile << " and the two beside it"
                 << "; see tests/golden/README.md before committing it";
  }
};

TEST_F(Golden, KnownSegmentIsEncodedToTheFileByteForByte) {
  EXPECT_EQ(Encode(SampleSegment(42, 3, 4)), ReadFile(kFile));
}

TEST_F(Golden, FileIsDecodedToTheKnownSegment) {
  const Result<Segment> decoded = Decode(ReadFile(kFile));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, SampleSegment(42, 3, 4));
}

TEST_F(Golden, SegmentWithKeyViewsIsEncodedToItsFileAndDecodedFromIt) {
  const Segment segment = SampleSegmentWithKeyViews(42, 3);
  EXPECT_EQ(Encode(segment), ReadFile(kFileWithKeyViews));
  const Result<Segment> decoded = Decode(ReadFile(kFileWithKeyViews));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, segment);
}

TEST_F(Golden, SegmentDrivenBackwardsIsEncodedToItsFileAndDecodedFromIt) {
  const Segment segment = SampleSegmentDrivenBackwards(42, 3);
  EXPECT_EQ(Encode(segment), ReadFile(kFileDrivenBackwards));
  const Result<Segment> decoded = Decode(ReadFile(kFileDrivenBackwards));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(*decoded, segment);
}

// Stores and receipts hold digests of these bytes: written out here so that regenerating the file
// by mistake does not go unseen.
TEST_F(Golden, DigestIsTheOneOfVersion4) {
  EXPECT_EQ(ToHex(Sha256(ReadFile(kFile))),
            "561a1614615657eb9964f6b76fa59375e5ee5c78709667953eb813dd1ece01b9");
}

}  // namespace
}  // namespace trailcast::route
