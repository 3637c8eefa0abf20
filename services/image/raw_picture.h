#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/image/picture_run.h"

namespace trailcast::image {

// A picture as a camera's driver hands it over, without owning its bytes. `encoding` is a name from
// ROS's sensor_msgs/image_encodings.
struct RawPicture {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::string encoding;
  bool big_endian = false;  // of 16-bit encodings
  std::uint32_t step = 0;   // bytes from one row to the next
  std::span<const std::uint8_t> bytes;
};

// Converts the next picture of a run. Pictures of 16 bits a pixel keep the bits that the run uses.
// An encoding that is not understood (the message lists those that are) and a picture without a
// size are kInvalidArgument. Rows that overlap and missing bytes are kCorrupt.
[[nodiscard]] Result<GrayImage> GrayFromRaw(const RawPicture& picture, PictureRun& run);

}  // namespace trailcast::image
