#include "services/dds/src/ros2/ros2_wire.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "ros2.h"
#include "services/motion/attitude.h"
#include "services/motion/imu.h"

namespace trailcast::dds {
namespace {

// sensor_msgs/Imu has this first in the covariance of what an IMU does not measure.
constexpr double kNotMeasured = -1.0;

// IDL texts are mutable in C, but nobody writes to these.
template <std::size_t N>
char* Text(std::array<char, N>& text) {
  return text.data();
}

builtin_interfaces_msg_dds__Time_ ToTime(SensorTime stamp) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
  return {static_cast<std::int32_t>(seconds.count()),
          static_cast<std::uint32_t>((stamp - seconds).count())};
}

SensorTime FromTime(const builtin_interfaces_msg_dds__Time_& time) {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

std::string FromText(const char* text) { return text == nullptr ? std::string() : text; }

template <typename Sequence>
std::vector<std::uint8_t> FromBytes(const Sequence& sequence) {
  const std::span bytes(sequence._buffer, sequence._length);
  return {bytes.begin(), bytes.end()};
}

geometry_msgs_msg_dds__Twist_ ToTwist(const motion::VelocityCommand& velocity) {
  geometry_msgs_msg_dds__Twist_ twist{};
  twist.linear.x = velocity.linear_mps;
  twist.angular.z = velocity.angular_radps;
  return twist;
}

std::optional<motion::VelocityCommand> FromTwist(const geometry_msgs_msg_dds__Twist_& twist) {
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z)) return std::nullopt;
  return motion::VelocityCommand{twist.linear.x, twist.angular.z};
}

}  // namespace

const dds_topic_descriptor_t& ImageType(bool compressed) {
  return compressed ? sensor_msgs_msg_dds__CompressedImage__desc : sensor_msgs_msg_dds__Image__desc;
}

const dds_topic_descriptor_t& OdometryType() { return nav_msgs_msg_dds__Odometry__desc; }

const dds_topic_descriptor_t& ScanType() { return sensor_msgs_msg_dds__LaserScan__desc; }

const dds_topic_descriptor_t& RangeType() { return sensor_msgs_msg_dds__Range__desc; }

const dds_topic_descriptor_t& ImuType() { return sensor_msgs_msg_dds__Imu__desc; }

const dds_topic_descriptor_t& BatteryType() { return sensor_msgs_msg_dds__BatteryState__desc; }

const dds_topic_descriptor_t& CommandType(Ros2CommandType type) {
  return type == Ros2CommandType::kTwist ? geometry_msgs_msg_dds__Twist__desc
                                         : geometry_msgs_msg_dds__TwistStamped__desc;
}

Result<void> WithRos2Wire(const Ros2Image& image, const UseSample& use) {
  std::array<char, 7> frame{"camera"};
  std::string encoding = image.encoding;
  sensor_msgs_msg_dds__Image_ wire{};
  wire.header.stamp = ToTime(image.stamp);
  wire.header.frame_id = Text(frame);
  wire.height = image.height_px;
  wire.width = image.width_px;
  wire.encoding = encoding.data();
  wire.is_bigendian = image.big_endian ? 1 : 0;
  wire.step = image.step;
  wire.data._length = static_cast<std::uint32_t>(image.data.size());
  wire.data._maximum = wire.data._length;
  wire.data._buffer = const_cast<std::uint8_t*>(image.data.data());  // only read
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Odometry& odometry, const UseSample& use) {
  std::array<char, 5> frame{"odom"};
  std::array<char, 10> body{"base_link"};
  nav_msgs_msg_dds__Odometry_ wire{};
  wire.header.stamp = ToTime(odometry.stamp);
  wire.header.frame_id = Text(frame);
  wire.child_frame_id = Text(body);
  wire.pose.pose.position.x = odometry.pose.x_m;
  wire.pose.pose.position.y = odometry.pose.y_m;
  wire.pose.pose.orientation.z = std::sin(odometry.pose.heading_rad / 2.0);
  wire.pose.pose.orientation.w = std::cos(odometry.pose.heading_rad / 2.0);
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Scan& scan, const UseSample& use) {
  std::array<char, 6> frame{"laser"};
  const motion::Scan& seen = scan.scan;
  const double turned_rad = seen.step_rad * (static_cast<double>(seen.ranges_m.size()) - 1.0);
  sensor_msgs_msg_dds__LaserScan_ wire{};
  wire.header.stamp = ToTime(scan.stamp);
  wire.header.frame_id = Text(frame);
  wire.angle_min = static_cast<float>(seen.first_rad);
  wire.angle_max = static_cast<float>(seen.first_rad + turned_rad);
  wire.angle_increment = static_cast<float>(seen.step_rad);
  wire.range_min = static_cast<float>(seen.least_m);
  wire.range_max = static_cast<float>(seen.most_m);
  wire.ranges._length = static_cast<std::uint32_t>(seen.ranges_m.size());
  wire.ranges._maximum = wire.ranges._length;
  wire.ranges._buffer = const_cast<float*>(seen.ranges_m.data());  // only read
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Range& range, const UseSample& use) {
  std::array<char, 6> frame{"range"};
  sensor_msgs_msg_dds__Range_ wire{};
  wire.header.stamp = ToTime(range.stamp);
  wire.header.frame_id = Text(frame);
  wire.field_of_view = static_cast<float>(range.range.field_rad);
  wire.min_range = static_cast<float>(range.range.least_m);
  wire.max_range = static_cast<float>(range.range.most_m);
  wire.range = range.range.range_m;
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Imu& imu, const UseSample& use) {
  std::array<char, 10> body{"base_link"};
  sensor_msgs_msg_dds__Imu_ wire{};
  wire.header.stamp = ToTime(imu.stamp);
  wire.header.frame_id = Text(body);
  wire.angular_velocity_covariance[0] = kNotMeasured;
  wire.orientation_covariance[0] = kNotMeasured;
  if (const auto& attitude = imu.felt.attitude) {
    wire.orientation = {attitude->x, attitude->y, attitude->z, attitude->w};
    wire.orientation_covariance[0] = 0.0;
  }
  wire.linear_acceleration_covariance[0] = kNotMeasured;
  if (const auto& acceleration = imu.felt.acceleration_mps2) {
    wire.linear_acceleration = {acceleration->x(), acceleration->y(), acceleration->z()};
    wire.linear_acceleration_covariance[0] = 0.0;
  }
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Battery& battery, const UseSample& use) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  std::array<char, 8> frame{"battery"};
  sensor_msgs_msg_dds__BatteryState_ wire{};
  wire.header.stamp = ToTime(battery.stamp);
  wire.header.frame_id = Text(frame);
  wire.voltage = wire.temperature = wire.current = wire.design_capacity = kUnknown;
  wire.charge = battery.charge_ah;
  wire.capacity = battery.capacity_ah;
  wire.percentage = battery.percentage;
  wire.present = true;
  return use(&wire);
}

Result<void> WithRos2Wire(const Ros2Command& command, Ros2CommandType type, const UseSample& use) {
  if (type == Ros2CommandType::kTwist) {
    const auto wire = ToTwist(command.velocity);
    return use(&wire);
  }
  std::array<char, 10> body{"base_link"};
  geometry_msgs_msg_dds__TwistStamped_ wire{};
  wire.header.stamp = ToTime(command.stamp);
  wire.header.frame_id = Text(body);
  wire.twist = ToTwist(command.velocity);
  return use(&wire);
}

Ros2Sensed ImageFromWire(const void* sample, bool compressed) {
  if (compressed) {
    const auto& wire = *static_cast<const sensor_msgs_msg_dds__CompressedImage_*>(sample);
    return Ros2CompressedImage{FromTime(wire.header.stamp), FromText(wire.format),
                               FromBytes(wire.data)};
  }
  const auto& wire = *static_cast<const sensor_msgs_msg_dds__Image_*>(sample);
  return Ros2Image{.stamp = FromTime(wire.header.stamp),
                   .width_px = wire.width,
                   .height_px = wire.height,
                   .encoding = FromText(wire.encoding),
                   .big_endian = wire.is_bigendian != 0,
                   .step = wire.step,
                   .data = FromBytes(wire.data)};
}

Result<Ros2Odometry> OdometryFromWire(const void* sample) {
  const auto& wire = *static_cast<const nav_msgs_msg_dds__Odometry_*>(sample);
  const auto& position = wire.pose.pose.position;
  const auto& q = wire.pose.pose.orientation;
  const motion::Attitude attitude{q.x, q.y, q.z, q.w};
  if (!std::isfinite(position.x) || !std::isfinite(position.y)) {
    return Fail(ErrorCode::kCorrupt, "the position in it is ({:g}, {:g}), which is none",
                position.x, position.y);
  }
  const auto heading_rad = motion::Heading(attitude);
  if (!heading_rad) return Fail(ErrorCode::kCorrupt, "{}", motion::WithoutHeading(attitude));
  return Ros2Odometry{FromTime(wire.header.stamp), {position.x, position.y, *heading_rad}};
}

std::optional<Ros2Scan> ScanFromWire(const void* sample) {
  const auto& wire = *static_cast<const sensor_msgs_msg_dds__LaserScan_*>(sample);
  const std::span ranges(wire.ranges._buffer, wire.ranges._length);
  if (ranges.size() > motion::kMostRanges) return std::nullopt;
  Ros2Scan scan{FromTime(wire.header.stamp),
                {wire.angle_min,
                 wire.angle_increment,
                 wire.range_min,
                 wire.range_max,
                 {ranges.begin(), ranges.end()}}};
  if (!motion::Plausible(scan.scan)) return std::nullopt;
  return scan;
}

std::optional<Ros2Range> RangeFromWire(const void* sample, std::size_t sensor) {
  const auto& wire = *static_cast<const sensor_msgs_msg_dds__Range_*>(sample);
  const Ros2Range range{FromTime(wire.header.stamp),
                        sensor,
                        {wire.field_of_view, wire.min_range, wire.max_range, wire.range}};
  if (!motion::Plausible(range.range)) return std::nullopt;
  return range;
}

std::optional<Ros2Imu> ImuFromWire(const void* sample) {
  const auto& wire = *static_cast<const sensor_msgs_msg_dds__Imu_*>(sample);
  Ros2Imu imu{FromTime(wire.header.stamp), {}};
  const auto& q = wire.orientation;
  const motion::Attitude attitude{q.x, q.y, q.z, q.w};
  // Drivers without an orientation leave zeros, too.
  if (wire.orientation_covariance[0] != kNotMeasured && motion::Climb(attitude)) {
    imu.felt.attitude = attitude;
  }
  const auto& a = wire.linear_acceleration;
  const Eigen::Vector3d acceleration_mps2(a.x, a.y, a.z);
  if (wire.linear_acceleration_covariance[0] != kNotMeasured && acceleration_mps2.allFinite()) {
    imu.felt.acceleration_mps2 = acceleration_mps2;
  }
  if (!imu.felt.attitude && !imu.felt.acceleration_mps2) return std::nullopt;
  return imu;
}

Ros2Battery BatteryFromWire(const void* sample) {
  const auto& wire = *static_cast<const sensor_msgs_msg_dds__BatteryState_*>(sample);
  return {FromTime(wire.header.stamp), wire.percentage, wire.charge, wire.capacity};
}

std::optional<Ros2Command> CommandFromWire(const void* sample, Ros2CommandType type) {
  if (type == Ros2CommandType::kTwist) {
    const auto velocity = FromTwist(*static_cast<const geometry_msgs_msg_dds__Twist_*>(sample));
    if (!velocity) return std::nullopt;
    return Ros2Command{{}, *velocity};
  }
  const auto& wire = *static_cast<const geometry_msgs_msg_dds__TwistStamped_*>(sample);
  const auto velocity = FromTwist(wire.twist);
  if (!velocity) return std::nullopt;
  return Ros2Command{FromTime(wire.header.stamp), *velocity};
}

}  // namespace trailcast::dds
