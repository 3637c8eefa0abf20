#include "services/image/picture_check.h"

#include "services/image/src/picture_layout.h"

namespace trailcast::image {

Result<void> CheckPicture(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels) {
  const PictureLayout layout = ReadPictureLayout(bytes);
  const std::uint64_t pixels = layout.pixels;
  if (pixels == 0) return Fail(ErrorCode::kInvalidArgument, "this is no JPEG and no PNG");
  if (pixels > most_pixels) {
    return Fail(ErrorCode::kInvalidArgument,
                "the picture has {} pixels; at most {} are looked at: make it smaller", pixels,
                most_pixels);
  }
  // A progressive JPEG has about ten scans. Each costs a pass over all pixels and may take only a
  // few bytes.
  constexpr std::ptrdiff_t kMostScans = 64;
  if (layout.scans > kMostScans) {
    return Fail(ErrorCode::kInvalidArgument, "the picture has {} scans; at most {} are decoded",
                layout.scans, kMostScans);
  }
  return {};
}

}  // namespace trailcast::image
