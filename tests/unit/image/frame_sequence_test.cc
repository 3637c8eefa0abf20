#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "services/image/files.h"
#include "tests/support/temp_dir.h"

namespace trailcast::image {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

GrayImage Plain(int width, int height, std::uint8_t grey) {
  return {width, height, std::vector<std::uint8_t>(PixelIndex(0, height, width), grey)};
}

void Write(const GrayImage& frame, const std::filesystem::path& file) {
  const auto written = WritePng(frame, file);
  ASSERT_TRUE(written) << written.error().message;
}

TEST(FrameSequence, FolderGivesItsPicturesInTheOrderOfTheirNames) {
  const test::TempDir folder;
  Write(Plain(8, 6, 30), folder / "000003.png");
  Write(Plain(8, 6, 10), folder / "000001.png");
  Write(Plain(8, 6, 20), folder / "000002.PNG");
  std::ofstream(folder / "odometry.csv") << "t_s,x_m,y_m,heading_rad\n";
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_EQ((*frames)->size(), 3);
  EXPECT_EQ((*frames)->rate_hz(), std::nullopt);
  for (const int grey : {10, 20, 30}) {
    const auto frame = (*frames)->Next();
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(frame->has_value());
    EXPECT_EQ((*frame)->at(0, 0), grey);
  }
  const auto end = (*frames)->Next();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->has_value());
}

TEST(FrameSequence, NumbersInNamesCountAsNumbers) {
  const test::TempDir folder;
  const std::vector<std::string> names{"a1.png",  "f1.png",   "f2.png",  "f09.png",
                                       "f10.png", "f10b.png", "f100.png"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    Write(Plain(8, 6, static_cast<std::uint8_t>(10 * i)), folder / names[i]);
  }
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames) << frames.error().message;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ((*frames)->Next().value()->at(0, 0), 10 * i) << names[i];
  }
}

TEST(FrameSequence, MissingFolderIsNotFound) {
  const test::TempDir folder;
  const auto frames = FrameSequence::Open(folder / "absent");
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(frames.error().message, HasSubstr("absent"));
}

TEST(FrameSequence, FolderWithoutPicturesIsNotFound) {
  const test::TempDir folder;
  std::ofstream(folder / "readme.txt") << "nothing here";
  const auto frames = FrameSequence::Open(folder.path());
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(frames.error().message, HasSubstr("no pictures"));
}

TEST(FrameSequence, SinglePictureIsRefused) {
  const test::TempDir folder;
  Write(Plain(8, 6, 10), folder / "one.png");
  const auto frames = FrameSequence::Open(folder / "one.png");
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kInvalidArgument);
}

TEST(FrameSequence, PicturesThatCannotBeReadAreLeftOutAndCounted) {
  const test::TempDir folder;
  for (int i = 0; i < 6; ++i) {
    Write(Plain(64, 48, static_cast<std::uint8_t>(10 * i)), folder / (std::to_string(i) + ".png"));
  }
  for (const char* empty : {"0.png", "5.png"}) std::filesystem::resize_file(folder / empty, 0);
  std::filesystem::resize_file(folder / "2.png", 60);
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  EXPECT_EQ((*frames)->size(), 6);
  for (const int number : {1, 3, 4}) {
    const auto frame = (*frames)->Next();
    ASSERT_TRUE(frame && *frame) << number;
    EXPECT_EQ((*frame)->at(0, 0), 10 * number);
    EXPECT_EQ((*frames)->number(), number);
    EXPECT_THAT((*frames)->TakeNews(), IsEmpty());
  }
  const auto end = (*frames)->Next();
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_FALSE(*end);
  EXPECT_THAT((*frames)->TakeNews(),
              ElementsAre(AllOf(HasSubstr("3 of 6 pictures"), HasSubstr("0.png"))));
  EXPECT_THAT((*frames)->TakeNews(), IsEmpty());
}

// Times go by the number of a picture, so what never was one must not count.
TEST(FrameSequence, WhatIsNoFileIsNoPictureAndALinkThatLeadsNowhereIsALostOne) {
  const test::TempDir folder;
  for (const char* name : {"1.png", "6.png"}) Write(Plain(8, 6, 10), folder / name);
  std::filesystem::create_directory(folder / "2.png");
  ASSERT_EQ(mkfifo((folder / "3.png").c_str(), 0600), 0);
  std::filesystem::create_symlink("4.png", folder / "4.png");
  std::filesystem::create_symlink("/nowhere/5.png", folder / "5.png");
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  EXPECT_EQ((*frames)->size(), 4);
  for (const int number : {0, 3}) {
    const auto frame = (*frames)->Next();
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(*frame);
    EXPECT_EQ((*frames)->number(), number);
  }
  EXPECT_FALSE((*frames)->Next().value());
  EXPECT_THAT((*frames)->TakeNews(),
              ElementsAre(AllOf(HasSubstr("2 of 4 pictures"), HasSubstr("4.png"))));
}

TEST(FrameSequence, ARunOfWhichTooMuchCannotBeReadEndsThere) {
  const test::TempDir folder;
  for (int i = 100; i < 200; ++i) Write(Plain(8, 6, 10), folder / (std::to_string(i) + ".png"));
  for (int i = 150; i < 200; ++i) {
    std::filesystem::resize_file(folder / (std::to_string(i) + ".png"), 0);
  }
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE((*frames)->Next());
  const auto ended = (*frames)->Next();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(ended.error().message,
              AllOf(HasSubstr("11 of 61 pictures"), HasSubstr("150.png"), HasSubstr("too many")));
}

// macOS keeps what it knows of a file beside it.
TEST(FrameSequence, HiddenFilesAreNoPictures) {
  const test::TempDir folder;
  Write(Plain(8, 6, 10), folder / "1.png");
  for (const char* hidden : {"._1.png", ".2.png"}) std::ofstream(folder / hidden) << "Mac OS X";
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  EXPECT_EQ((*frames)->size(), 1);
  EXPECT_TRUE((*frames)->Next().value());
  EXPECT_FALSE((*frames)->Next().value());
}

// A JPEG of 16 by 8, black but for its right half, which says how it is to be turned.
std::vector<std::uint8_t> JpegTurned(int orientation) {
  GrayImage picture = Plain(16, 8, 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 8; x < 16; ++x) picture.pixels[PixelIndex(x, y, 16)] = 255;
  }
  std::vector<std::uint8_t> jpeg = EncodeJpeg(picture, 95).value();
  // APP1 of 34 bytes: "Exif", a big-endian TIFF, one directory of one entry, no other directory.
  std::vector<std::uint8_t> exif{
      0xFF, 0xE1, 0, 34, 'E', 'x', 'i', 'f', 0, 0,
      'M',  'M',  0, 42, 0,   0,   0,   8,   0, 1,
      1,    0x12, 0, 3,  0,   0,   0,   1,   0, static_cast<std::uint8_t>(orientation),
      0,    0,    0, 0,  0,   0};
  jpeg.insert(jpeg.begin() + 2, exif.begin(), exif.end());
  return jpeg;
}

TEST(DecodeGray, APictureIsTurnedAsItSays) {
  // Where the white half comes to lie, as OpenCV turns it, too.
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const auto jpeg = JpegTurned(orientation);
    const cv::Mat expected = cv::imdecode(jpeg, cv::IMREAD_GRAYSCALE);
    const auto read = DecodeGray(jpeg, "it");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->width, expected.cols) << orientation;
    ASSERT_EQ(read->height, expected.rows) << orientation;
    EXPECT_TRUE(std::equal(read->pixels.begin(), read->pixels.end(), expected.datastart))
        << orientation;
  }
}

// Returns a picture that grows brighter to the right and downwards.
GrayImage Slope(int width, int height) {
  GrayImage slope = Plain(width, height, 0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      slope.pixels[PixelIndex(x, y, width)] =
          static_cast<std::uint8_t>(160 * x / width + 80 * y / height);
    }
  }
  return slope;
}

TEST(DecodeGray, ALargeJpegIsReducedAsLongAsEnoughOfItIsLeft) {
  struct Case {
    int width, height, enough_px, reduced;
  };
  for (const Case& each : std::vector<Case>{{320, 200, 0, 1},
                                            {320, 200, 161, 1},
                                            {320, 200, 160, 2},
                                            {200, 320, 160, 2},
                                            {321, 201, 160, 2},
                                            {320, 200, 81, 2},
                                            {320, 200, 80, 4},
                                            {320, 200, 1, 8}}) {
    const GrayImage whole = Slope(each.width, each.height);
    PictureRun run(each.enough_px);
    const auto read = DecodeGray(EncodeJpeg(whole, 95).value(), "it", run);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(run.reduced(), each.reduced) << each.enough_px;
    ASSERT_EQ(read->width, (each.width + each.reduced - 1) / each.reduced) << each.enough_px;
    ASSERT_EQ(read->height, (each.height + each.reduced - 1) / each.reduced) << each.enough_px;
    for (const auto& [x, y] : {std::pair(1, 1), {read->width / 2, read->height / 3}}) {
      const int middle = each.reduced / 2;
      EXPECT_NEAR(read->at(x, y), whole.at(each.reduced * x + middle, each.reduced * y + middle), 4)
          << each.enough_px;
    }
  }
}

TEST(DecodeGray, OfAReducedRunOtherFormatsComeWhole) {
  const test::TempDir folder;
  Write(Slope(320, 200), folder / "1.png");
  auto frames = FrameSequence::Open(folder.path(), 80);
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_EQ((*frames)->Next().value()->width, 320);
  EXPECT_EQ((*frames)->reduced(), 1);
}

TEST(FrameSequence, APictureOfAnotherSizeIsOneHoweverItIsReduced) {
  const test::TempDir folder;
  for (const auto& [name, width] : {std::pair("1.jpg", 160), {"2.jpg", 320}}) {
    const auto jpeg = EncodeJpeg(Slope(width, width / 2), 95).value();
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(jpeg.data()), std::ssize(jpeg));
  }
  auto frames = FrameSequence::Open(folder.path(), 160);
  ASSERT_TRUE(frames);
  ASSERT_TRUE((*frames)->Next());
  const auto odd = (*frames)->Next();
  ASSERT_FALSE(odd);
  EXPECT_THAT(odd.error().message, AllOf(HasSubstr("320x160"), HasSubstr("160x80")));
}

TEST(FrameSequence, AllPicturesOfARunAreTurnedAsTheFirst) {
  for (const int first : {1, 3}) {
    const test::TempDir folder;
    const int others = 4 - first;
    for (int i = 0; i < 3; ++i) {
      const auto jpeg = JpegTurned(i == 0 ? first : others);
      std::ofstream(folder / (std::to_string(i) + ".jpg"), std::ios::binary)
          .write(reinterpret_cast<const char*>(jpeg.data()), std::ssize(jpeg));
    }
    auto frames = FrameSequence::Open(folder.path());
    ASSERT_TRUE(frames);
    std::vector<std::string> news;
    while (const auto frame = (*frames)->Next().value()) {
      EXPECT_EQ(frame->at(2, 2) > 128, first == 3);
      for (std::string& each : (*frames)->TakeNews()) news.push_back(std::move(each));
    }
    ASSERT_EQ(news.size(), first == 3 ? 2U : 1U);
    EXPECT_THAT(news.back(), HasSubstr("turned otherwise than the first"));
  }
}

TEST(FrameSequence, PictureOfAnotherSizeIsNamedWithBothSizes) {
  const test::TempDir folder;
  Write(Plain(8, 6, 10), folder / "1.png");
  Write(Plain(6, 8, 10), folder / "2.png");
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  ASSERT_TRUE((*frames)->Next());
  const auto odd = (*frames)->Next();
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(odd.error().message, AllOf(HasSubstr("2.png"), HasSubstr("6x8"), HasSubstr("8x6")));
}

void WriteVideo(int frames, const std::filesystem::path& file) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25.0, cv::Size(64, 48));
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i)
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 + i * 20)));
}

TEST(FrameSequence, VideoGivesItsFramesAndItsRate) {
  const test::TempDir folder;
  WriteVideo(5, folder / "run.avi");
  auto frames = FrameSequence::Open(folder / "run.avi");
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_NEAR((*frames)->rate_hz().value_or(0.0), 25.0, 0.1);
  for (int i = 0; i < 5; ++i) {
    const auto frame = (*frames)->Next();
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(frame->has_value());
    EXPECT_EQ((*frame)->width, 64);
    EXPECT_NEAR((*frame)->at(30, 20), 40 + i * 20, 3);
  }
  const auto end = (*frames)->Next();
  ASSERT_TRUE(end) << end.error().message;
  EXPECT_FALSE(end->has_value());
}

TEST(FrameSequence, TextWithAVideosNameIsCorrupt) {
  const test::TempDir folder;
  std::ofstream(folder / "run.avi") << "this is no video";
  const auto frames = FrameSequence::Open(folder / "run.avi");
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(frames.error().message, HasSubstr("run.avi"));
}

}  // namespace
}  // namespace trailcast::image
