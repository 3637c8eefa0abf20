#include "services/bag/ros_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/recorded/ros2_bytes.h"
#include "tests/support/recorded/ros_messages.h"

namespace trailcast::bag {
namespace {

using std::chrono::nanoseconds;
using Bytes = std::vector<std::uint8_t>;

constexpr nanoseconds kStamp{1'700'000'000'123'456'789};
const image::GrayImage kPicture{3, 2, {1, 2, 3, 4, 5, 6}};

TEST(ReadImage, GivesWhatTheCameraSaid) {
  const Bytes message = test::ImageMessage(kStamp, kPicture);
  const auto image = ReadImage(message);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->stamp, kStamp);
  EXPECT_EQ(image->picture.width_px, 3U);
  EXPECT_EQ(image->picture.height_px, 2U);
  EXPECT_EQ(image->picture.encoding, "mono8");
  EXPECT_EQ(image->picture.step, 3U);
  EXPECT_EQ(Bytes(image->picture.bytes.begin(), image->picture.bytes.end()), kPicture.pixels);
}

TEST(ReadCompressedImage, GivesItsBytes) {
  const Bytes bytes{9, 8, 7};
  const Bytes message = test::CompressedImageMessage(kStamp, bytes);
  const auto image = ReadCompressedImage(message);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->stamp, kStamp);
  EXPECT_EQ(Bytes(image->bytes.begin(), image->bytes.end()), bytes);
}

TEST(ReadOdometry, OfEitherByteOrder) {
  for (const bool little_endian : {true, false}) {
    const auto odometry =
        ReadOdometry(test::OdometryMessage(kStamp, {1.5, -2.5, 0.75}, little_endian));
    ASSERT_TRUE(odometry);
    EXPECT_EQ(odometry->stamp, kStamp);
    EXPECT_DOUBLE_EQ(odometry->pose.x_m, 1.5);
    EXPECT_DOUBLE_EQ(odometry->pose.y_m, -2.5);
    EXPECT_NEAR(odometry->pose.heading_rad, 0.75, 1e-12);
  }
}

// In the second encoding numbers of eight bytes are aligned to four.
TEST(ReadOdometry, OfTheSecondEncoding) {
  test::CdrWriter cdr;
  cdr.PutHeader(kStamp, "odom");  // 8 + 4 + 5 bytes
  cdr.PutText("base_lin");        // to byte 33, so that the doubles begin at 36
  Bytes message = cdr.Message();
  message[1] = 7;
  message.resize(4 + 36);
  for (const double number : {1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    const Bytes bytes = test::CdrWriter().PutDouble(number).Message();
    message.insert(message.end(), bytes.begin() + 4, bytes.end());
  }
  const auto odometry = ReadOdometry(message);
  ASSERT_TRUE(odometry) << odometry.error().message;
  EXPECT_DOUBLE_EQ(odometry->pose.x_m, 1.0);
  EXPECT_DOUBLE_EQ(odometry->pose.y_m, 2.0);
}

// Also padded, and of a newer definition that says more.
TEST(RosMessages, OfOtherPeoplesWritersAreRead) {
  constexpr nanoseconds kTheirs{1'700'000'000'500'000'000};
  for (const bool little : {true, false}) {
    for (const int more : {0, 1, 3, 64}) {
      SCOPED_TRACE(testing::Message() << (little ? "little" : "big") << " endian, " << more);
      const Bytes image_bytes = test::Recorded(test::kImage, little, more);
      const auto image = ReadImage(image_bytes);
      ASSERT_TRUE(image) << image.error().message;
      EXPECT_EQ(image->stamp, kTheirs);
      EXPECT_EQ(image->picture.width_px, 3U);
      EXPECT_EQ(image->picture.height_px, 2U);
      EXPECT_EQ(image->picture.encoding, "16UC1");
      EXPECT_EQ(image->picture.big_endian, !little);
      EXPECT_EQ(image->picture.step, 6U);
      EXPECT_EQ(Bytes(image->picture.bytes.begin(), image->picture.bytes.end()),
                (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));

      const Bytes jpeg_bytes = test::Recorded(test::kCompressedImage, little, more);
      const auto jpeg = ReadCompressedImage(jpeg_bytes);
      ASSERT_TRUE(jpeg) << jpeg.error().message;
      EXPECT_EQ(jpeg->stamp, kTheirs);
      EXPECT_EQ(Bytes(jpeg->bytes.begin(), jpeg->bytes.end()), (Bytes{0xFF, 0xD8, 0xFF, 0xD9, 7}));

      const auto odometry = ReadOdometry(test::Recorded(test::kOdometry, little, more));
      ASSERT_TRUE(odometry) << odometry.error().message;
      EXPECT_EQ(odometry->stamp, kTheirs);
      EXPECT_EQ(odometry->pose.x_m, 1.5);
      EXPECT_EQ(odometry->pose.y_m, -2.5);
      EXPECT_NEAR(odometry->pose.heading_rad, 2.0 * std::atan2(0.6, 0.8), 1e-12);
    }
  }
}

TEST(ReadOdometry, AnOrientationThatIsNoneIsTold) {
  test::CdrWriter cdr;
  cdr.PutHeader(kStamp, "odom").PutText("base_link");
  for (int i = 0; i < 7; ++i) cdr.PutDouble(0.0);
  const auto odometry = ReadOdometry(cdr.Message());
  ASSERT_FALSE(odometry);
  EXPECT_NE(odometry.error().message.find("quaternion (0, 0, 0, 0)"), std::string::npos)
      << odometry.error().message;
}

TEST(ReadOdometry, NumbersThatAreNoneAreDamage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ReadOdometry(test::OdometryMessage(kStamp, {nan, 0.0, 0.0})));
  EXPECT_FALSE(ReadOdometry(test::OdometryMessage(kStamp, {0.0, 0.0, nan})));
}

TEST(ReadTwist, OfEitherType) {
  const motion::VelocityCommand told{0.4, -0.7};
  const auto plain = ReadTwist(test::TwistMessage(told), false);
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(*plain, told);
  const auto stamped = ReadTwist(test::TwistStampedMessage(kStamp, told), true);
  ASSERT_TRUE(stamped) << stamped.error().message;
  EXPECT_EQ(*stamped, told);
}

TEST(ReadTwist, NumbersThatAreNoneAndTooFewOfThemAreDamage) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ReadTwist(test::TwistMessage({nan, 0.0}), false));
  EXPECT_FALSE(ReadTwist(test::TwistMessage({0.0, nan}), false));
  const Bytes whole = test::TwistStampedMessage(kStamp, {0.4, -0.7});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(ReadTwist(std::span(whole).first(size), true)) << size;
  }
}

TEST(RosMessages, CutAnywhereAreDamage) {
  const Bytes image = test::ImageMessage(kStamp, kPicture);
  for (std::size_t size = 0; size < image.size(); ++size) {
    const auto read = ReadImage(std::span(image).first(size));
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().code, ErrorCode::kCorrupt);
  }
  Bytes other = image;
  other[1] = 3;  // a parameter list
  EXPECT_FALSE(ReadImage(other));
}

TEST(PlainType, IsTheSameForAllVersionsOfRos) {
  EXPECT_EQ(PlainType("sensor_msgs/msg/Image"), kImageType);
  EXPECT_EQ(PlainType("sensor_msgs/Image"), kImageType);
}

}  // namespace
}  // namespace trailcast::bag
