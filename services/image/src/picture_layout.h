#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::image {

// The facts that a picture tells before it is decoded. A JPEG is read from marker to marker as
// decoders read it; bytes behind its end (a phone's film, a camera's own data) do not count.
struct PictureLayout {
  // 0 if it is neither PNG nor JPEG or is cut off before it says so. A decoder allocates memory for
  // that many before it looks at the rest.
  std::uint64_t pixels = 0;
  bool cut_off = false;  // it is a JPEG without its end

  // These are of a JPEG alone.
  std::uint64_t longer_side_px = 0;
  std::ptrdiff_t scans = 0;
  std::optional<int> orientation{};  // 1 to 8, as Exif numbers them, of one that is not cut off

  // Returns how it is to be turned; 1 leaves it as it is.
  [[nodiscard]] int turn() const { return orientation.value_or(1); }
};
[[nodiscard]] PictureLayout ReadPictureLayout(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::image
