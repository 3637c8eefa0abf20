#pragma once

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "services/image/image.h"
#include "services/motion/motion.h"

// These are the messages of ROS 2 as its nodes write them: CDR, encoding 1.
namespace trailcast::test {

class CdrWriter {
 public:
  explicit CdrWriter(bool little_endian = true) : little_endian_(little_endian) {}

  template <typename Number>
  CdrWriter& Put(Number number) {
    while (bytes_.size() % sizeof(Number) != 0) bytes_.push_back(0);
    const auto value = static_cast<std::uint64_t>(number);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      const std::size_t byte = little_endian_ ? i : sizeof(Number) - 1 - i;
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8U * byte)));
    }
    return *this;
  }
  CdrWriter& PutDouble(double number) { return Put(std::bit_cast<std::uint64_t>(number)); }
  CdrWriter& PutText(const std::string& text) {
    Put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
    return *this;
  }
  CdrWriter& PutOctets(std::span<const std::uint8_t> octets) {
    Put(static_cast<std::uint32_t>(octets.size()));
    bytes_.insert(bytes_.end(), octets.begin(), octets.end());
    return *this;
  }
  CdrWriter& PutHeader(std::chrono::nanoseconds stamp, const std::string& frame) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
    Put(static_cast<std::uint32_t>(seconds.count()));
    return Put(static_cast<std::uint32_t>((stamp - seconds).count())).PutText(frame);
  }
  // Returns the bytes with the four before them that tell the encoding.
  [[nodiscard]] std::vector<std::uint8_t> Message() const {
    std::vector<std::uint8_t> message{0, static_cast<std::uint8_t>(little_endian_ ? 1 : 0), 0, 0};
    message.insert(message.end(), bytes_.begin(), bytes_.end());
    return message;
  }

 private:
  bool little_endian_;
  std::vector<std::uint8_t> bytes_;
};

inline std::vector<std::uint8_t> ImageMessage(std::chrono::nanoseconds stamp,
                                              const image::GrayImage& picture,
                                              const std::string& encoding = "mono8") {
  CdrWriter cdr;
  cdr.PutHeader(stamp, "camera");
  cdr.Put(static_cast<std::uint32_t>(picture.height));
  cdr.Put(static_cast<std::uint32_t>(picture.width));
  cdr.PutText(encoding).Put(std::uint8_t{0}).Put(static_cast<std::uint32_t>(picture.width));
  return cdr.PutOctets(picture.pixels).Message();
}

inline std::vector<std::uint8_t> CompressedImageMessage(std::chrono::nanoseconds stamp,
                                                        std::span<const std::uint8_t> bytes) {
  return CdrWriter().PutHeader(stamp, "camera").PutText("jpeg").PutOctets(bytes).Message();
}

inline std::vector<std::uint8_t> OdometryMessage(std::chrono::nanoseconds stamp,
                                                 const motion::Pose2& pose,
                                                 bool little_endian = true) {
  constexpr int kCovariance = 36;
  constexpr int kTwist = 6;
  CdrWriter cdr(little_endian);
  cdr.PutHeader(stamp, "odom").PutText("base_link");
  cdr.PutDouble(pose.x_m).PutDouble(pose.y_m).PutDouble(0.0);
  cdr.PutDouble(0.0).PutDouble(0.0);
  cdr.PutDouble(std::sin(pose.heading_rad / 2)).PutDouble(std::cos(pose.heading_rad / 2));
  for (int i = 0; i < kCovariance + kTwist + kCovariance; ++i) cdr.PutDouble(0.0);
  return cdr.Message();
}

inline std::vector<std::uint8_t> TwistMessage(const motion::VelocityCommand& command) {
  CdrWriter cdr;
  cdr.PutDouble(command.linear_mps).PutDouble(0.0).PutDouble(0.0);
  cdr.PutDouble(0.0).PutDouble(0.0).PutDouble(command.angular_radps);
  return cdr.Message();
}

inline std::vector<std::uint8_t> TwistStampedMessage(std::chrono::nanoseconds stamp,
                                                     const motion::VelocityCommand& command) {
  CdrWriter cdr;
  cdr.PutHeader(stamp, "base_link");
  cdr.PutDouble(command.linear_mps).PutDouble(0.0).PutDouble(0.0);
  cdr.PutDouble(0.0).PutDouble(0.0).PutDouble(command.angular_radps);
  return cdr.Message();
}

}  // namespace trailcast::test
