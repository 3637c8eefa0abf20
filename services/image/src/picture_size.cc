#include "services/image/src/picture_size.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace trailcast::image {
namespace {

std::uint64_t Number(std::span<const std::uint8_t> big_endian) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : big_endian) value = value << 8U | byte;
  return value;
}

template <std::size_t kSize>
bool BeginsWith(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, kSize>& start) {
  return bytes.size() >= kSize && std::equal(start.begin(), start.end(), bytes.begin());
}

// https://www.w3.org/TR/png-3/, 11.2.1: the first chunk is IHDR; width and height come first in it.
std::uint64_t OfPng(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kWidthAt = 16;
  if (bytes.size() < kWidthAt + 8) return 0;
  return Number(bytes.subspan(kWidthAt, 4)) * Number(bytes.subspan(kWidthAt + 4, 4));
}

// ITU-T T.81, B.1.1.3: a frame's header has one of the markers SOF0 to SOF15, from which the
// numbers of three other segments are missing.
bool IsFrame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// From segment to segment: FF, marker, two bytes of length that count themselves.
std::uint64_t OfJpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHeader = 4;
  constexpr std::size_t kHeightAt = 5;  // after the sample precision
  std::size_t at = 2;
  while (at + kHeader <= bytes.size() && bytes[at] == 0xFF) {
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // fill
      ++at;
      continue;
    }
    if (IsFrame(marker)) {
      if (at + kHeightAt + 4 > bytes.size()) return 0;
      return Number(bytes.subspan(at + kHeightAt, 2)) *
             Number(bytes.subspan(at + kHeightAt + 2, 2));
    }
    at += 2 + std::max<std::size_t>(2, Number(bytes.subspan(at + 2, 2)));
  }
  return 0;
}

}  // namespace

bool IsJpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 2> kJpeg = {0xFF, 0xD8};
  return BeginsWith(bytes, kJpeg);
}

std::uint64_t PromisedPixels(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  if (BeginsWith(bytes, kPng)) return OfPng(bytes);
  return IsJpeg(bytes) ? OfJpeg(bytes) : 0;
}

}  // namespace trailcast::image
