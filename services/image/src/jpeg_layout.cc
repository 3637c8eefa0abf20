#include "services/image/src/jpeg_layout.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "services/image/src/exif.h"

namespace trailcast::image {
namespace {

// These are from ITU-T T.81, table B.1.
constexpr std::uint8_t kTemporary = 0x01;
constexpr std::uint8_t kFirstRestart = 0xD0;
constexpr std::uint8_t kLastRestart = 0xD7;
constexpr std::uint8_t kStart = 0xD8;
constexpr std::uint8_t kEnd = 0xD9;
constexpr std::uint8_t kScan = 0xDA;
constexpr std::uint8_t kExif = 0xE1;
constexpr std::size_t kLengthBytes = 2;

// T.81, section B.1.1.3: a frame's header has one of the markers SOF0 to SOF15, without three
// numbers that belong to other segments.
bool IsFrame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// These markers have no segment. A 0 is no marker, but stands for a byte FF within a scan.
bool StandsAlone(std::uint8_t marker) {
  return marker == 0 || marker == kTemporary || (marker >= kFirstRestart && marker <= kLastRestart);
}

std::uint64_t BigEndian(std::span<const std::uint8_t> bytes) {
  return std::uint64_t{bytes[0]} << 8U | bytes[1];
}

// A frame's header begins with the sample precision, then height and width. The largest frame of a
// file that has several counts.
void TakeFrame(std::span<const std::uint8_t> frame, JpegLayout& layout) {
  if (frame.size() < 5) return;
  const std::uint64_t height = BigEndian(frame.subspan(1));
  const std::uint64_t width = BigEndian(frame.subspan(3));
  layout.pixels = std::max(layout.pixels, width * height);
  layout.longer_side_px = std::max({layout.longer_side_px, width, height});
}

// Returns the next marker and leaves in `left` what follows it; 0 if there is none.
std::uint8_t TakeMarker(std::span<const std::uint8_t>& left) {
  auto at = std::find(left.begin(), left.end(), 0xFF);
  at = std::find_if(at, left.end(), [](std::uint8_t byte) { return byte != 0xFF; });
  if (at == left.end()) {
    left = {};
    return 0;
  }
  left = left.subspan(static_cast<std::size_t>(at - left.begin()) + 1);
  return *at;
}

}  // namespace

bool IsJpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 2> kJpeg = {0xFF, kStart};
  return bytes.size() >= kJpeg.size() && std::equal(kJpeg.begin(), kJpeg.end(), bytes.begin());
}

JpegLayout ReadJpegLayout(std::span<const std::uint8_t> bytes) {
  JpegLayout layout;
  if (!IsJpeg(bytes)) return layout;
  std::span<const std::uint8_t> left = bytes.subspan(2);
  while (!left.empty()) {
    const std::uint8_t marker = TakeMarker(left);
    if (StandsAlone(marker)) continue;
    layout.whole = marker == kEnd;
    if (marker == kEnd || marker == kStart || left.size() < kLengthBytes) break;
    const auto length = static_cast<std::size_t>(BigEndian(left));
    if (length < kLengthBytes || length > left.size()) break;
    const auto content = left.subspan(kLengthBytes, length - kLengthBytes);
    if (IsFrame(marker)) TakeFrame(content, layout);
    if (marker == kScan) ++layout.scans;
    if (marker == kExif) layout.orientation = ExifOrientation(content).value_or(layout.orientation);
    left = left.subspan(length);
  }
  return layout;
}

}  // namespace trailcast::image
