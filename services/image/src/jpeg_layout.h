#pragma once

#include <cstdint>
#include <span>

namespace trailcast::image {

// What a JPEG says of itself before anything is decoded, read from marker to marker as decoders do.
// What lies behind its end (a phone's film, a camera's own data) is no part of it.
struct JpegLayout {
  std::uint64_t pixels = 0;  // 0: cut off before it says so
  std::ptrdiff_t scans = 0;
  int orientation = 1;  // 1 to 8, as Exif numbers them; 1: as it is
  bool whole = false;   // it has its end
};
[[nodiscard]] JpegLayout ReadJpegLayout(std::span<const std::uint8_t> bytes);

[[nodiscard]] bool IsJpeg(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::image
