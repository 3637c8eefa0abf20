#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/image/picture_run.h"

namespace trailcast::image {

// A picture as a camera's driver hands it over; `encoding` is a name of ROS's
// sensor_msgs/image_encodings. Does not own its bytes.
struct RawPicture {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::string encoding;
  bool big_endian = false;  // of 16-bit encodings
  std::uint32_t step = 0;   // bytes from one row to the next
  std::span<const std::uint8_t> bytes;
};

// The next picture of a run: of 16 bits a pixel those that the run's pictures use.
// kInvalidArgument for an encoding that is not understood (the message lists those that are), a
// picture of no size; kCorrupt for rows that overlap or fewer bytes than the rows need.
[[nodiscard]] Result<GrayImage> GrayFromRaw(const RawPicture& picture, PictureRun& run);

}  // namespace trailcast::image
