#pragma once

#include <cstdint>
#include <span>

namespace trailcast::image {

// The facts that a JPEG tells before it is decoded, read from marker to marker as decoders read it.
// Bytes behind its end (a phone's film, a camera's own data) do not count.
struct JpegLayout {
  std::uint64_t pixels = 0;  // 0 if it is cut off before it says so
  std::uint64_t longer_side_px = 0;
  std::ptrdiff_t scans = 0;
  int orientation = 1;  // 1 to 8, as Exif numbers them; 1 leaves it as it is
  bool whole = false;   // it has its end
};
[[nodiscard]] JpegLayout ReadJpegLayout(std::span<const std::uint8_t> bytes);

[[nodiscard]] bool IsJpeg(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::image
