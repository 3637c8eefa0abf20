#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/image/raw_picture.h"
#include "services/motion/motion.h"

// The messages of ROS 2 that a recorded drive is made of, out of their CDR bytes, either byte
// order, encoding 1 or 2. What they hold of bytes lies in the message's and lives as long.
namespace trailcast::bag {

inline constexpr const char* kImageType = "sensor_msgs/Image";
inline constexpr const char* kCompressedImageType = "sensor_msgs/CompressedImage";
inline constexpr const char* kOdometryType = "nav_msgs/Odometry";
inline constexpr const char* kTwistType = "geometry_msgs/Twist";
inline constexpr const char* kTwistStampedType = "geometry_msgs/TwistStamped";
// As above, without the "msg/" that a ROS 2 type has in the middle.
[[nodiscard]] std::string PlainType(const std::string& type);

struct RosImage {
  SensorTime stamp{};
  image::RawPicture picture;
};
struct RosCompressedImage {
  SensorTime stamp{};
  std::span<const std::uint8_t> bytes;
};
struct RosOdometry {
  SensorTime stamp{};
  motion::Pose2 pose;  // in the odometry's own frame
};

// Errors are kCorrupt: bytes that are too few for what they say, numbers that are none.
[[nodiscard]] Result<RosImage> ReadImage(std::span<const std::uint8_t> message);
[[nodiscard]] Result<RosCompressedImage> ReadCompressedImage(std::span<const std::uint8_t> message);
[[nodiscard]] Result<RosOdometry> ReadOdometry(std::span<const std::uint8_t> message);
// Of either type.
[[nodiscard]] Result<motion::VelocityCommand> ReadTwist(std::span<const std::uint8_t> message,
                                                        bool stamped);

}  // namespace trailcast::bag
