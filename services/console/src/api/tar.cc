#include "services/console/src/api/tar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace trailcast::console {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kNameBytes = 100;
constexpr std::size_t kChecksumAt = 148;
constexpr std::size_t kChecksumBytes = 8;

}  // namespace

// The fields and their places are those of struct posix_header.
std::string TarHeader(const std::string& name, std::uint64_t bytes, std::int64_t unix_s) {
  std::string header(kBlock, '\0');
  const auto put = [&](std::size_t at, std::string_view text) {
    std::copy(text.begin(), text.end(), header.begin() + static_cast<std::ptrdiff_t>(at));
  };
  put(0, std::string_view(name).substr(0, kNameBytes - 1));
  put(100, "0000644");
  put(108, "0000000");
  put(116, "0000000");
  put(124, fmt::format("{:011o}", bytes));
  put(136, fmt::format("{:011o}", std::max<std::int64_t>(0, unix_s)));
  put(kChecksumAt, std::string(kChecksumBytes, ' '));
  put(156, "0");
  put(257, "ustar");
  put(263, "00");
  unsigned sum = 0;
  for (const char c : header) sum += static_cast<unsigned char>(c);
  put(kChecksumAt, fmt::format("{:06o}", sum));
  header[kChecksumAt + 6] = '\0';
  return header;
}

std::string TarPadding(std::uint64_t bytes) {
  return std::string(static_cast<std::size_t>((kBlock - bytes % kBlock) % kBlock), '\0');
}

std::string TarEnd() { return std::string(2 * kBlock, '\0'); }

}  // namespace trailcast::console
