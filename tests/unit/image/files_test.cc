#include "services/image/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "services/image/picture_check.h"
#include "services/image/src/picture_layout.h"
#include "tests/support/temp_dir.h"

namespace trailcast::image {
namespace {

using ::testing::HasSubstr;

GrayImage Gradient(int width, int height) {
  GrayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixels.push_back(static_cast<std::uint8_t>((7 * x + 3 * y + (x * y) % 11) % 256));
    }
  }
  return image;
}

// Writes what is left of an encoded picture when only a share of its bytes was written.
void WriteTruncated(const std::string& extension, double share, const std::filesystem::path& file) {
  GrayImage image = Gradient(64, 48);
  const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(extension, view, bytes));
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(share * static_cast<double>(bytes.size())));
}

TEST(Files, GrayPictureSurvivesWritingAndReading) {
  const test::TempDir folder;
  const GrayImage written = Gradient(31, 17);
  ASSERT_TRUE(WritePng(written, folder / "a.png"));
  const auto read = ReadGray(folder / "a.png");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width, 31);
  EXPECT_EQ(read->height, 17);
  EXPECT_EQ(read->pixels, written.pixels);
}

TEST(Files, WhatAStrangerSendsIsLookedAtBeforeItIsDecoded) {
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(Gradient(64, 48), 95).value();
  EXPECT_TRUE(CheckPicture(jpeg, 64 * 48));
  const auto large = CheckPicture(jpeg, 64 * 48 - 1);
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("3072 pixels; at most 3071"));
  for (const std::string text : {"", "GIF89a", "\x89PNG\r\n\x1a\n", "\xFF\xD8"}) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    EXPECT_FALSE(CheckPicture(bytes, 1'000'000)) << text;
  }
  std::vector<std::uint8_t> scans = jpeg;
  for (int i = 0; i < 65; ++i) scans.insert(scans.end() - 2, {0xFF, 0xDA, 0, 2});
  EXPECT_THAT(CheckPicture(scans, 1'000'000).error().message, HasSubstr("scans"));
}

TEST(Files, PicturesAreMadeJpegInGreyAndInColour) {
  const GrayImage gray = Gradient(64, 48);
  const auto written = EncodeJpeg(gray, 95);
  ASSERT_TRUE(written) << written.error().message;
  const auto read = DecodeGray(*written, "gray");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width, 64);
  EXPECT_EQ(read->height, 48);
  const auto coarse = EncodeJpeg(gray, 20);
  ASSERT_TRUE(coarse);
  EXPECT_LT(2 * coarse->size(), written->size());

  RgbImage red{16, 8, {}};
  for (int i = 0; i < 16 * 8; ++i) red.pixels.insert(red.pixels.end(), {220, 30, 40});
  const auto coloured = DecodeRgb(EncodeJpeg(red, 90).value(), "red");
  ASSERT_TRUE(coloured) << coloured.error().message;
  EXPECT_NEAR(coloured->pixels[0], 220, 6);
  EXPECT_NEAR(coloured->pixels[1], 30, 6);
  EXPECT_NEAR(coloured->pixels[2], 40, 6);

  EXPECT_FALSE(EncodeJpeg(GrayImage{}, 90));
  const auto wide = EncodeJpeg(GrayImage{70'000, 1, std::vector<std::uint8_t>(70'000)}, 90);
  ASSERT_FALSE(wide) << "JPEG has no such width";
  EXPECT_THAT(wide.error().message, HasSubstr("70000x1"));
}

TEST(Files, RgbPictureKeepsItsChannelOrder) {
  const test::TempDir folder;
  const RgbImage written{2, 1, {200, 100, 50, 1, 2, 3}};
  ASSERT_TRUE(WritePng(written, folder / "a.png"));
  const auto read = ReadRgb(folder / "a.png");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->pixels, written.pixels);
  // OpenCV itself holds blue first: the file must agree with other programs, not only with us.
  const cv::Mat bgr = cv::imread((folder / "a.png").string());
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(50, 100, 200));
}

TEST(Files, MissingPictureIsNotFoundAndNamed) {
  const test::TempDir folder;
  const auto read = ReadGray(folder / "absent.png");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(read.error().message, HasSubstr("absent.png"));
}

TEST(Files, FolderInPlaceOfAPictureIsRefused) {
  const test::TempDir folder;
  const auto read = ReadGray(folder.path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kInvalidArgument);
}

TEST(Files, TextInPlaceOfAPictureIsCorruptAndNamed) {
  const test::TempDir folder;
  std::ofstream(folder / "notes.png") << "this is no picture";
  const auto read = ReadRgb(folder / "notes.png");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(read.error().message, HasSubstr("notes.png"));
}

TEST(Files, EmptyFileIsCorrupt) {
  const test::TempDir folder;
  std::ofstream(folder / "empty.jpg") << "";
  const auto read = ReadGray(folder / "empty.jpg");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
}

class TruncatedPicture : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(TruncatedPicture, IsCorruptAndNamed) {
  const test::TempDir folder;
  const auto& [extension, share] = GetParam();
  const auto file = folder / ("cut" + extension);
  WriteTruncated(extension, share, file);
  const auto read = ReadGray(file);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(read.error().message, HasSubstr("cut" + extension));
}

INSTANTIATE_TEST_SUITE_P(Formats, TruncatedPicture,
                         ::testing::Combine(::testing::Values(".png", ".jpg", ".bmp"),
                                            ::testing::Values(0.3, 0.6, 0.9)));

// A phone's film, a camera's own data: markers in them are none of the picture's.
TEST(Files, WhatLiesBehindAPicturesEndIsNoPartOfIt) {
  const test::TempDir folder;
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(Gradient(64, 48), 95).value();
  std::vector<std::uint8_t> longer = jpeg;
  for (int i = 0; i < 100; ++i) longer.insert(longer.end(), {'f', 't', 0xFF, 0xDA, 0, 12, 0xFF});
  std::ofstream(folder / "motion.jpg", std::ios::binary)
      .write(reinterpret_cast<const char*>(longer.data()), std::ssize(longer));
  const auto read = ReadGray(folder / "motion.jpg");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->pixels, DecodeGray(jpeg, "it")->pixels);
  EXPECT_TRUE(CheckPicture(longer, 64 * 48));
  // One that was cut off is not made whole by what comes after.
  longer.erase(longer.begin() + std::ssize(jpeg) - 2, longer.begin() + std::ssize(jpeg));
  EXPECT_FALSE(DecodeGray(longer, "it"));
}

TEST(Files, OfSixteenBitsThoseAreTakenThatAreUsed) {
  for (const int bits : {10, 12, 16}) {
    cv::Mat numbers(4, 8, CV_16UC1, cv::Scalar((1 << bits) - 1));
    numbers.at<std::uint16_t>(0, 0) = static_cast<std::uint16_t>(77 << (bits - 8) | 1);
    std::vector<std::uint8_t> png;
    ASSERT_TRUE(cv::imencode(".png", numbers, png));
    const auto read = DecodeGray(png, "it");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->at(0, 0), 77) << bits;
    EXPECT_EQ(read->at(1, 0), 255) << bits;
  }
}

TEST(PictureLayout, TellsTheNumberOfPixels) {
  GrayImage image = Gradient(64, 48);
  const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
  for (const char* extension : {".png", ".jpg"}) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(cv::imencode(extension, view, bytes));
    EXPECT_EQ(ReadPictureLayout(bytes).pixels, 64U * 48U) << extension;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::uint64_t promised = ReadPictureLayout(std::span(bytes).first(length)).pixels;
      EXPECT_TRUE(promised == 0 || promised == 64U * 48U) << extension << " cut to " << length;
    }
  }
  EXPECT_EQ(ReadPictureLayout({}).pixels, 0U);
}

// A few bytes, for which OpenCV would make room for a milliard pixels.
TEST(Files, APictureThatPromisesTooMuchIsRefusedBeforeItIsDecoded) {
  GrayImage image = Gradient(8, 8);
  const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(cv::imencode(".png", view, bytes));
  for (const std::size_t at : {18U, 22U}) bytes[at] = 0x7F;  // 32 520 each way
  const auto refused = DecodeRgb(bytes, "huge.png");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kCorrupt) << "left out of a run, and counted";
  EXPECT_THAT(refused.error().message, HasSubstr("huge.png says that it has 1057"));
}

TEST(Files, WritingIntoAMissingFolderFailsWithItsName) {
  const test::TempDir folder;
  const auto written = WritePng(Gradient(4, 4), folder / "no_such_folder" / "a.png");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(written.error().message, HasSubstr("no_such_folder"));
}

TEST(Files, EmptyPictureIsNotWritten) {
  const test::TempDir folder;
  EXPECT_FALSE(WritePng(RgbImage{}, folder / "a.png"));
  EXPECT_FALSE(WritePng(GrayImage{}, folder / "a.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace trailcast::image
