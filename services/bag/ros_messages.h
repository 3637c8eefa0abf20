#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/image/raw_picture.h"
#include "services/motion/motion.h"

// These functions decode the ROS 2 messages of a recorded drive from their CDR bytes, in either
// byte order and encoding 1 or 2. Bytes in the results are views into the message's and live as
// long.
namespace trailcast::bag {

inline constexpr const char* kImageType = "sensor_msgs/Image";
inline constexpr const char* kCompressedImageType = "sensor_msgs/CompressedImage";
inline constexpr const char* kOdometryType = "nav_msgs/Odometry";
inline constexpr const char* kTwistType = "geometry_msgs/Twist";
inline constexpr const char* kTwistStampedType = "geometry_msgs/TwistStamped";
// Returns the type without the "msg/" that ROS 2 has in the middle.
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

// Errors are kCorrupt: the message has fewer bytes than it says, or numbers that are not finite.
[[nodiscard]] Result<RosImage> ReadImage(std::span<const std::uint8_t> message);
[[nodiscard]] Result<RosCompressedImage> ReadCompressedImage(std::span<const std::uint8_t> message);
[[nodiscard]] Result<RosOdometry> ReadOdometry(std::span<const std::uint8_t> message);
// Reads Twist or TwistStamped.
[[nodiscard]] Result<motion::VelocityCommand> ReadTwist(std::span<const std::uint8_t> message,
                                                        bool stamped);

}  // namespace trailcast::bag
