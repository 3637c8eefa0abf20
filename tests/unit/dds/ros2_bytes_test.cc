// Messages of ROS 2 that others wrote, as Cyclone's reading of CDR and ours of its samples have
// them.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/q_protocol.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "services/dds/src/ros2/ros2_wire.h"
#include "tests/support/places.h"
#include "tests/support/recorded/ros2_bytes.h"

namespace trailcast::dds {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr SensorTime kTheirs = std::chrono::nanoseconds(1'700'000'000'500'000'000);

// A sample of the type, read from a message's bytes.
class Sample {
 public:
  Sample(const dds_topic_descriptor_t& type, const test::Ros2Bytes& message, bool little, int more)
      : type_(type), memory_((type.m_size + sizeof(Unit) - 1) / sizeof(Unit)) {
    std::vector<std::uint8_t> bytes = test::Recorded(message, little, more);
    constexpr std::size_t kEncapsulation = 4;
    auto* data = reinterpret_cast<char*>(bytes.data()) + kEncapsulation;  // normalised in place
    const auto size = static_cast<std::uint32_t>(bytes.size() - kEncapsulation);
    const bool swap = little != (std::endian::native == std::endian::little);
    std::uint32_t end = 0;
    read_ = dds_stream_normalize_data(data, &end, size, swap, CDR_ENC_VERSION_1, type.m_ops);
    if (!read_) return;
    dds_istream_t stream;
    dds_istream_init(&stream, size, data, CDR_ENC_VERSION_1);
    dds_stream_read(&stream, reinterpret_cast<char*>(memory_.data()), type.m_ops);
  }
  ~Sample() { dds_stream_free_sample(reinterpret_cast<char*>(memory_.data()), type_.m_ops); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

  [[nodiscard]] bool read() const { return read_; }
  [[nodiscard]] const void* data() const { return memory_.data(); }

 private:
  using Unit = std::uint64_t;
  const dds_topic_descriptor_t& type_;
  std::vector<Unit> memory_;
  bool read_ = false;
};

// Byte order; how many bytes come after all that the message's definition had in Humble.
class Ros2BytesTest : public testing::TestWithParam<std::tuple<bool, int>> {
 protected:
  // Calls `expect` with the sample.
  template <typename Expect>
  static void Read(const dds_topic_descriptor_t& type, const test::Ros2Bytes& message,
                   const Expect& expect) {
    const auto& [little, more] = GetParam();
    const Sample sample(type, message, little, more);
    ASSERT_TRUE(sample.read()) << type.m_typename;
    expect(sample.data());
  }
};

TEST_P(Ros2BytesTest, PicturesAreRead) {
  Read(ImageType(false), test::kImage, [](const void* sample) {
    const auto image = std::get<Ros2Image>(ImageFromWire(sample, false));
    EXPECT_EQ(image.stamp, kTheirs);
    EXPECT_EQ(image.width_px, 3U);
    EXPECT_EQ(image.height_px, 2U);
    EXPECT_EQ(image.encoding, "16UC1");
    EXPECT_EQ(image.big_endian, !std::get<0>(GetParam()));
    EXPECT_EQ(image.step, 6U);
    EXPECT_THAT(image.data, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
  });
  Read(ImageType(true), test::kCompressedImage, [](const void* sample) {
    const auto image = std::get<Ros2CompressedImage>(ImageFromWire(sample, true));
    EXPECT_EQ(image.stamp, kTheirs);
    EXPECT_EQ(image.format, "rgb8; jpeg compressed bgr8");
    EXPECT_THAT(image.data, ElementsAre(0xFF, 0xD8, 0xFF, 0xD9, 7));
  });
}

TEST_P(Ros2BytesTest, OdometryIsRead) {
  Read(OdometryType(), test::kOdometry, [](const void* sample) {
    const auto odometry = OdometryFromWire(sample);
    ASSERT_TRUE(odometry) << odometry.error().message;
    EXPECT_EQ(odometry->stamp, kTheirs);
    EXPECT_EQ(odometry->pose.x_m, 1.5);
    EXPECT_EQ(odometry->pose.y_m, -2.5);
    EXPECT_NEAR(odometry->pose.heading_rad, 2.0 * std::atan2(0.6, 0.8), 1e-12);
  });
}

TEST_P(Ros2BytesTest, CommandsAreRead) {
  const motion::VelocityCommand velocity{0.5, -0.25};
  Read(CommandType(Ros2CommandType::kTwist), test::kTwist, [&](const void* sample) {
    EXPECT_EQ(CommandFromWire(sample, Ros2CommandType::kTwist)->velocity, velocity);
  });
  Read(CommandType(Ros2CommandType::kTwistStamped), test::kTwistStamped, [&](const void* sample) {
    const auto command = CommandFromWire(sample, Ros2CommandType::kTwistStamped);
    EXPECT_EQ(command->velocity, velocity);
    EXPECT_EQ(command->stamp, kTheirs);
  });
}

TEST_P(Ros2BytesTest, ScansAndRangesAreRead) {
  Read(ScanType(), test::kLaserScan, [](const void* sample) {
    const auto scan = ScanFromWire(sample);
    ASSERT_TRUE(scan);
    EXPECT_EQ(scan->stamp, kTheirs);
    EXPECT_EQ(scan->scan.first_rad, -1.5F);
    EXPECT_EQ(scan->scan.step_rad, 1.5F);
    EXPECT_THAT(scan->scan.ranges_m, ElementsAre(1.0F, 2.0F, 4.0F));
  });
  Read(RangeType(), test::kRange, [](const void* sample) {
    const auto range = RangeFromWire(sample, 3);
    ASSERT_TRUE(range);
    EXPECT_EQ(range->stamp, kTheirs);
    EXPECT_EQ(range->sensor, 3U);
    EXPECT_EQ(range->range.range_m, 2.5F);
  });
}

TEST_P(Ros2BytesTest, InertiaAndBatteriesAreRead) {
  Read(ImuType(), test::kImu, [](const void* sample) {
    const auto imu = ImuFromWire(sample);
    ASSERT_TRUE(imu);
    EXPECT_EQ(imu->stamp, kTheirs);
    ASSERT_TRUE(imu->felt.attitude);
    EXPECT_EQ(imu->felt.attitude->y, 0.6);
    EXPECT_EQ(imu->felt.acceleration_mps2, Eigen::Vector3d(0.5, -0.25, 9.75));
  });
  Read(BatteryType(), test::kBatteryState, [](const void* sample) {
    const auto battery = BatteryFromWire(sample);
    EXPECT_EQ(battery.stamp, kTheirs);
    EXPECT_EQ(battery.percentage, 0.5F);
    EXPECT_EQ(battery.charge_ah, 5.0F);
    EXPECT_EQ(battery.capacity_ah, 10.0F);
  });
}

INSTANTIATE_TEST_SUITE_P(All, Ros2BytesTest,
                         testing::Combine(testing::Bool(), testing::Values(0, 1, 3, 64)));

// These have what Foxglove's code writes by Humble's and by Jazzy's definitions
// (tests/golden/ros2).
class Ros2GoldenTest : public testing::TestWithParam<std::string> {
 protected:
  static std::map<std::string, std::string> Golden(const std::string& distribution) {
    std::ifstream in(fs::path(SourceDir()) / "tests/golden/ros2" / (distribution + ".txt"));
    std::map<std::string, std::string> hex_of;
    for (std::string name, hex; in >> name >> hex;) hex_of[name] = hex;
    return hex_of;
  }
};

TEST_P(Ros2GoldenTest, AnothersCodeWritesTheBytesThatAreReadHere) {
  std::map<std::string, test::Ros2Bytes> ours{
      {"sensor_msgs/Image", test::kImage},
      {"sensor_msgs/CompressedImage", test::kCompressedImage},
      {"nav_msgs/Odometry", test::kOdometry},
      {"geometry_msgs/Twist", test::kTwist},
      {"geometry_msgs/TwistStamped", test::kTwistStamped},
      {"sensor_msgs/LaserScan", test::kLaserScan},
      {"sensor_msgs/Range", test::kRange},
      {"sensor_msgs/Imu", test::kImu},
      {"sensor_msgs/BatteryState", test::kBatteryState}};
  const std::string variance = "0000003f";  // which is newer, and not read
  if (GetParam() == "jazzy") ours["sensor_msgs/Range"].little += variance;
  const auto theirs = Golden(GetParam());
  EXPECT_EQ(theirs.size(), ours.size());
  for (const auto& [name, hex] : theirs) {
    EXPECT_EQ(test::FromHex(hex), test::Recorded(ours[name], true)) << name;
  }
}

// And their reader reads them.
TEST_P(Ros2GoldenTest, CommandsAreWrittenAsByAnothersCode) {
  const auto theirs = Golden(GetParam());
  const Ros2Command command{.stamp = kTheirs, .velocity = {0.5, -0.25}};
  for (const auto type : {Ros2CommandType::kTwist, Ros2CommandType::kTwistStamped}) {
    const char* name =
        type == Ros2CommandType::kTwist ? "geometry_msgs/Twist" : "geometry_msgs/TwistStamped";
    const auto written = WithRos2Wire(command, type, [&](const void* sample) -> Result<void> {
      dds_ostreamLE_t stream;
      dds_ostreamLE_init(&stream, 0, CDR_ENC_VERSION_1);
      EXPECT_NE(
          dds_stream_writeLE(&stream, static_cast<const char*>(sample), CommandType(type).m_ops),
          nullptr);
      const std::vector<std::uint8_t> bytes(stream.x.m_buffer,
                                            stream.x.m_buffer + stream.x.m_index);
      dds_ostreamLE_fini(&stream);
      std::vector<std::uint8_t> expected = test::FromHex(theirs.at(name));
      expected.erase(expected.begin(), expected.begin() + 4);  // how it is encoded
      EXPECT_EQ(bytes, expected) << name;
      return {};
    });
    EXPECT_TRUE(written);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Ros2GoldenTest, testing::Values("humble", "jazzy"),
                         [](const auto& of) { return of.param; });

TEST(Ros2Bytes, OdometryWhoseOrientationIsNoneIsToldSo) {
  const test::Ros2Bytes zeros{
      test::kOdometry.little.substr(0, 2 * 32) + test::Times(96, "00000000000000000000"), ""};
  const Sample sample(OdometryType(), zeros, true, 0);
  ASSERT_TRUE(sample.read());
  const auto odometry = OdometryFromWire(sample.data());
  ASSERT_FALSE(odometry);
  EXPECT_THAT(odometry.error().message, HasSubstr("quaternion (0, 0, 0, 0)"));
}

}  // namespace
}  // namespace trailcast::dds
