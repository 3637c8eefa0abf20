#include "agent/device/src/ros2/ros2_picture.h"

#include "services/image/files.h"
#include "services/image/raw_picture.h"

namespace trailcast::agent {

SensorTime StampOf(const Ros2Picture& picture) {
  return std::visit([](const auto& message) { return message.stamp; }, picture);
}

const std::vector<std::uint8_t>& BytesOf(const Ros2Picture& picture) {
  return std::visit(
      [](const auto& message) -> const std::vector<std::uint8_t>& { return message.data; },
      picture);
}

Result<image::GrayImage> Gray(const Ros2Picture& picture, const std::string& topic,
                              image::PictureRun& run) {
  if (const auto* jpeg = std::get_if<dds::Ros2CompressedImage>(&picture)) {
    return image::DecodeGray(jpeg->data, topic, run);
  }
  const auto& raw = std::get<dds::Ros2Image>(picture);
  auto gray = image::GrayFromRaw(
      {raw.width_px, raw.height_px, raw.encoding, raw.big_endian, raw.step, raw.data}, run);
  if (!gray) return Wrap(gray.error(), topic);
  return gray;
}

}  // namespace trailcast::agent
