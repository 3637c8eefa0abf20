#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "services/dds/ros2_link.h"
#include "services/image/image.h"
#include "services/image/picture_run.h"

namespace trailcast::agent {

// A picture of a ROS 2 camera as it came.
using Ros2Picture = std::variant<dds::Ros2Image, dds::Ros2CompressedImage>;

[[nodiscard]] SensorTime StampOf(const Ros2Picture& picture);
[[nodiscard]] const std::vector<std::uint8_t>& BytesOf(const Ros2Picture& picture);

// Converts the camera's next picture. Messages begin with `topic`. kCorrupt means that this picture
// is damaged, but another may be well; any other error holds for the camera.
[[nodiscard]] Result<image::GrayImage> Gray(const Ros2Picture& picture, const std::string& topic,
                                            image::PictureRun& run);

}  // namespace trailcast::agent
