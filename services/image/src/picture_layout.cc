#include "services/image/src/picture_layout.h"

#include <algorithm>
#include <array>

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
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

template <std::size_t kSize>
bool BeginsWith(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, kSize>& start) {
  return bytes.size() >= kSize && std::equal(start.begin(), start.end(), bytes.begin());
}

// https://www.w3.org/TR/png-3/, section 11.2.1: the first chunk is IHDR and begins with width and
// height.
PictureLayout OfPng(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kWidthAt = 16;
  if (bytes.size() < kWidthAt + 8) return {};
  return {.pixels =
              BigEndian(bytes.subspan(kWidthAt, 4)) * BigEndian(bytes.subspan(kWidthAt + 4, 4))};
}

// A frame's header begins with the sample precision, then height and width. The largest frame of a
// file that has several counts.
void TakeFrame(std::span<const std::uint8_t> frame, PictureLayout& layout) {
  if (frame.size() < 5) return;
  const std::uint64_t height = BigEndian(frame.subspan(1, 2));
  const std::uint64_t width = BigEndian(frame.subspan(3, 2));
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

PictureLayout OfJpeg(std::span<const std::uint8_t> bytes) {
  PictureLayout layout{.cut_off = true};
  int orientation = 1;
  std::span<const std::uint8_t> left = bytes.subspan(2);
  while (!left.empty()) {
    const std::uint8_t marker = TakeMarker(left);
    if (StandsAlone(marker)) continue;
    layout.cut_off = marker != kEnd;
    if (marker == kEnd || marker == kStart || left.size() < kLengthBytes) break;
    const auto length = static_cast<std::size_t>(BigEndian(left.first(kLengthBytes)));
    if (length < kLengthBytes || length > left.size()) break;
    const auto content = left.subspan(kLengthBytes, length - kLengthBytes);
    if (IsFrame(marker)) TakeFrame(content, layout);
    if (marker == kScan) ++layout.scans;
    if (marker == kExif) orientation = ExifOrientation(content).value_or(orientation);
    left = left.subspan(length);
  }
  if (!layout.cut_off) layout.orientation = orientation;
  return layout;
}

}  // namespace

PictureLayout ReadPictureLayout(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  constexpr std::array<std::uint8_t, 2> kJpeg = {0xFF, kStart};
  if (BeginsWith(bytes, kPng)) return OfPng(bytes);
  return BeginsWith(bytes, kJpeg) ? OfJpeg(bytes) : PictureLayout{};
}

}  // namespace trailcast::image
