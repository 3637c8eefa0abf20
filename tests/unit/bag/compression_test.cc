#include "services/bag/compression.h"

#include <gtest/gtest.h>

#include "services/bag/src/crc32.h"
#include "tests/support/recorded/bag_writers.h"
#include "tests/support/temp_dir.h"

namespace trailcast::bag {
namespace {

Bytes Text(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>((i * i) >> 3U);
  return bytes;
}

class Compressions : public testing::TestWithParam<Compression> {};

TEST_P(Compressions, WhatWasCompressedComesBack) {
  EXPECT_EQ(FindCompression(NameOf(GetParam())), GetParam());
  // About the size of the steps that it is done in, too.
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, (std::size_t{1} << 20U) - 1,
                                 std::size_t{1} << 20U, (std::size_t{1} << 20U) + 1}) {
    const Bytes bytes = Text(size);
    const Decompressed back = Decompress(GetParam(), Compress(GetParam(), bytes), size);
    EXPECT_TRUE(back.whole) << size;
    EXPECT_EQ(back.bytes, bytes) << size;
  }
}

TEST_P(Compressions, NoMoreThanTheBoundIsMade) {
  const Bytes packed = Compress(GetParam(), Bytes(std::size_t{50} << 20U));
  const Decompressed back = Decompress(GetParam(), packed, 1000);
  EXPECT_FALSE(back.whole);
  EXPECT_EQ(back.bytes, Bytes(1000));
  EXPECT_LT(back.bytes.capacity(), std::size_t{3} << 20U);
}

INSTANTIATE_TEST_SUITE_P(All, Compressions,
                         testing::Values(Compression::kNone, Compression::kLz4,
                                         Compression::kZstd));

TEST(Decompress, WhatIsNoneIsNotWhole) {
  const Bytes noise = Text(1000);
  EXPECT_FALSE(Decompress(Compression::kLz4, noise, 1 << 20).whole);
  EXPECT_FALSE(Decompress(Compression::kZstd, noise, 1 << 20).whole);
  EXPECT_FALSE(Decompress(Compression::kZstd, {}, 1 << 20).whole);
  EXPECT_FALSE(FindCompression("bz2"));
}

TEST(DecompressZstdFile, UnpacksFilesOfAnySize) {
  const test::TempDir folder;
  for (const std::size_t size : {std::size_t{1}, std::size_t{1} << 20U, std::size_t{3'000'000}}) {
    const Bytes bytes = Text(size);
    test::WriteBytes(folder / "a.zstd", Compress(Compression::kZstd, bytes));
    const auto whole = DecompressZstdFile(folder / "a.zstd", folder / "a");
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_TRUE(*whole);
    EXPECT_EQ(test::ReadBytes(folder / "a"), bytes);
  }
}

TEST(DecompressZstdFile, AFolderThatTakesNothingIsNamed) {
  const test::TempDir folder;
  test::WriteBytes(folder / "a.zstd", Compress(Compression::kZstd, Text(1000)));
  const auto failed = DecompressZstdFile(folder / "a.zstd", folder / "none/a");
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("TMPDIR"), std::string::npos);
}

TEST(Crc32, IsZlibs) {
  const std::string digits = "123456789";
  EXPECT_EQ(Crc32(Bytes(digits.begin(), digits.end())), 0xCBF43926U);
  EXPECT_EQ(Crc32({}), 0U);
}

}  // namespace
}  // namespace trailcast::bag
