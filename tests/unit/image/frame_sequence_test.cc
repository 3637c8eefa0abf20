#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "services/image/files.h"
#include "tests/support/temp_dir.h"

namespace trailcast::image {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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

TEST(FrameSequence, TruncatedPictureMidwayIsNamed) {
  const test::TempDir folder;
  Write(Plain(64, 48, 10), folder / "1.png");
  Write(Plain(64, 48, 10), folder / "2.png");
  std::filesystem::resize_file(folder / "2.png", 60);
  auto frames = FrameSequence::Open(folder.path());
  ASSERT_TRUE(frames);
  ASSERT_TRUE((*frames)->Next());
  const auto broken = (*frames)->Next();
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(broken.error().message, HasSubstr("2.png"));
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
