#include "services/image/src/exif.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace trailcast::image {
namespace {

constexpr std::array<std::uint8_t, 6> kExifName = {'E', 'x', 'i', 'f', 0, 0};
constexpr std::size_t kEntryBytes = 12;
constexpr std::uint64_t kOrientationTag = 0x0112;
constexpr std::uint64_t kShort = 3;

// Reads the numbers of a TIFF in its byte order; beyond its end they are 0.
class Tiff {
 public:
  explicit Tiff(std::span<const std::uint8_t> bytes)
      : bytes_(bytes), little_endian_(!bytes.empty() && bytes[0] == 'I') {}

  [[nodiscard]] std::uint64_t Number(std::uint64_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) return 0;
    const auto bytes = bytes_.subspan(static_cast<std::size_t>(at), size);
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
      number = number << 8U | bytes[little_endian_ ? size - 1 - i : i];
    }
    return number;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool little_endian_;
};

}  // namespace

// Exif 2.3, section 4.6.2: the segment holds a TIFF whose first directory has the tag.
std::optional<int> ExifOrientation(std::span<const std::uint8_t> app1) {
  if (app1.size() < kExifName.size() ||
      !std::equal(kExifName.begin(), kExifName.end(), app1.begin())) {
    return std::nullopt;
  }
  const Tiff tiff(app1.subspan(kExifName.size()));
  const std::uint64_t directory = tiff.Number(4, 4);
  const std::uint64_t entries = tiff.Number(directory, 2);
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t entry = directory + 2 + i * kEntryBytes;
    if (tiff.Number(entry, 2) != kOrientationTag || tiff.Number(entry + 2, 2) != kShort) continue;
    const std::uint64_t orientation = tiff.Number(entry + 8, 2);
    if (orientation >= 1 && orientation <= 8) return static_cast<int>(orientation);
  }
  return std::nullopt;
}

}  // namespace trailcast::image
