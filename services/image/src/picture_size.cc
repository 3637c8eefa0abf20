#include "services/image/src/picture_size.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "services/image/src/jpeg_layout.h"

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

// https://www.w3.org/TR/png-3/, section 11.2.1: the first chunk is IHDR and begins with width and
// height.
std::uint64_t OfPng(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kWidthAt = 16;
  if (bytes.size() < kWidthAt + 8) return 0;
  return Number(bytes.subspan(kWidthAt, 4)) * Number(bytes.subspan(kWidthAt + 4, 4));
}

}  // namespace

std::uint64_t PromisedPixels(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 8> kPng = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  if (BeginsWith(bytes, kPng)) return OfPng(bytes);
  return ReadJpegLayout(bytes).pixels;
}

}  // namespace trailcast::image
