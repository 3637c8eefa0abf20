#include "services/bag/ros_messages.h"

#include <cmath>

#include "services/bag/src/cdr_reader.h"
#include "services/motion/attitude.h"

namespace trailcast::bag {
namespace {

// A std_msgs/Header has builtin_interfaces/Time and the frame's name.
SensorTime TakeHeader(CdrReader& cdr) {
  const auto seconds = static_cast<std::int32_t>(cdr.Take<std::uint32_t>());
  const auto nanoseconds = cdr.Take<std::uint32_t>();
  (void)cdr.TakeText();
  return std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds);
}

tl::unexpected<Error> Damaged(const char* type) {
  return Fail(ErrorCode::kCorrupt, "a damaged message: it does not hold what a {} has", type);
}

}  // namespace

std::string PlainType(const std::string& type) {
  const std::size_t middle = type.find("/msg/");
  return middle == std::string::npos ? type : type.substr(0, middle) + type.substr(middle + 4);
}

Result<RosImage> ReadImage(std::span<const std::uint8_t> message) {
  CdrReader cdr(message);
  RosImage image;
  image.stamp = TakeHeader(cdr);
  image.picture.height_px = cdr.Take<std::uint32_t>();
  image.picture.width_px = cdr.Take<std::uint32_t>();
  image.picture.encoding = cdr.TakeText();
  image.picture.big_endian = cdr.Take<std::uint8_t>() != 0;
  image.picture.step = cdr.Take<std::uint32_t>();
  image.picture.bytes = cdr.TakeOctets();
  if (cdr.failed()) return Damaged(kImageType);
  return image;
}

Result<RosCompressedImage> ReadCompressedImage(std::span<const std::uint8_t> message) {
  CdrReader cdr(message);
  RosCompressedImage image;
  image.stamp = TakeHeader(cdr);
  (void)cdr.TakeText();  // the format, which the bytes tell as well
  image.bytes = cdr.TakeOctets();
  if (cdr.failed()) return Damaged(kCompressedImageType);
  return image;
}

Result<RosOdometry> ReadOdometry(std::span<const std::uint8_t> message) {
  CdrReader cdr(message);
  RosOdometry odometry;
  odometry.stamp = TakeHeader(cdr);
  (void)cdr.TakeText();  // the body's frame
  const double x_m = cdr.TakeDouble();
  const double y_m = cdr.TakeDouble();
  (void)cdr.TakeDouble();
  const motion::Attitude attitude{cdr.TakeDouble(), cdr.TakeDouble(), cdr.TakeDouble(),
                                  cdr.TakeDouble()};
  const auto heading_rad = motion::Heading(attitude);
  if (cdr.failed() || !std::isfinite(x_m) || !std::isfinite(y_m)) return Damaged(kOdometryType);
  if (!heading_rad) return Fail(ErrorCode::kCorrupt, "{}", motion::WithoutHeading(attitude));
  odometry.pose = {x_m, y_m, *heading_rad};
  return odometry;
}

Result<motion::VelocityCommand> ReadTwist(std::span<const std::uint8_t> message, bool stamped) {
  CdrReader cdr(message);
  if (stamped) (void)TakeHeader(cdr);
  motion::VelocityCommand command;
  command.linear_mps = cdr.TakeDouble();
  // These are the speeds to the side and up, and the turn rates about x and y.
  for (int i = 0; i < 4; ++i) (void)cdr.TakeDouble();
  command.angular_radps = cdr.TakeDouble();
  if (cdr.failed() || !std::isfinite(command.linear_mps) || !std::isfinite(command.angular_radps)) {
    return Damaged(stamped ? kTwistStampedType : kTwistType);
  }
  return command;
}

}  // namespace trailcast::bag
