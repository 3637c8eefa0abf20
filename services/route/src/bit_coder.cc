#include "services/route/src/bit_coder.h"

#include <algorithm>
#include <array>
#include <utility>

namespace trailcast::route {
namespace {

constexpr std::size_t kWindowBytes = sizeof(std::uint32_t);
constexpr unsigned kTopByte = 24;

// This is the logistic function of 0, 1/4, 1/2 ... 11, in 1/65536.
constexpr std::array<int, 45> kLogistic = {
    32768, 36843, 40793, 44511, 47911, 50941, 53581, 55834, 57724, 59287, 60565, 61598,
    62428, 63090, 63615, 64030, 64357, 64614, 64816, 64974, 65097, 65194, 65269, 65328,
    65374, 65410, 65438, 65459, 65476, 65489, 65500, 65508, 65514, 65519, 65523, 65526,
    65528, 65530, 65531, 65532, 65533, 65534, 65534, 65535, 65535};
constexpr int kStep = 64;  // of z, from one entry to the next

}  // namespace

int Logistic(int z) {
  constexpr int kMost = kStep * static_cast<int>(kLogistic.size() - 1) - 1;
  const int size = std::min(z < 0 ? -z : z, kMost);
  const auto entry = static_cast<std::size_t>(size / kStep);
  const int from = kLogistic.at(entry);
  const int value = from + (kLogistic.at(entry + 1) - from) * (size % kStep) / kStep;
  return z < 0 ? kCertain - value : value;
}

BitCoder::BitCoder(std::string_view bytes) : bytes_(bytes), reads_(true) {
  for (std::size_t i = 0; i < kWindowBytes; ++i) Shift();
  lowest_ = 0;
  highest_ = 0xffff'ffffU;
}

void BitCoder::Shift() {
  if (reads_) {
    const unsigned byte = next_ < bytes_.size() ? static_cast<std::uint8_t>(bytes_[next_]) : 0U;
    window_ = window_ << 8U | byte;
    ++next_;
  } else {
    written_.push_back(static_cast<char>(highest_ >> kTopByte));
  }
  lowest_ <<= 8U;
  highest_ = highest_ << 8U | 0xffU;
}

bool BitCoder::Code(bool bit, int likely) {
  const std::uint64_t range = highest_ - lowest_;
  const auto middle = static_cast<std::uint32_t>(
      lowest_ + (range * static_cast<std::uint64_t>(likely) >> kProbabilityBits));
  if (reads_) bit = window_ <= middle;
  if (bit) {
    highest_ = middle;
  } else {
    lowest_ = middle + 1;
  }
  while (((lowest_ ^ highest_) >> kTopByte) == 0) Shift();
  return bit;
}

std::uint32_t BitCoder::CodePlain(std::uint32_t value, int count) {
  std::uint32_t coded = 0;
  for (int i = count - 1; i >= 0; --i) {
    const bool bit = Code((value >> static_cast<unsigned>(i) & 1U) != 0, kCertain / 2);
    coded = coded << 1U | static_cast<std::uint32_t>(bit);
  }
  return coded;
}

// A reader reads zeros beyond the end. So the code ends with the number between lowest_ and
// highest_ that has the most zero bytes at its end, and those bytes are not written.
std::string BitCoder::Finish() {
  for (unsigned zeros = 32; lowest_ > 0 && zeros > 0;) {
    zeros -= 8;
    const std::uint64_t unit = std::uint64_t{1} << zeros;
    const std::uint64_t number = (lowest_ + unit - 1) / unit * unit;
    if (number > highest_) continue;
    for (unsigned shift = kTopByte; shift + 8 > zeros; shift -= 8) {
      written_.push_back(static_cast<char>(number >> shift & 0xffU));
      if (shift == 0) break;
    }
    break;
  }
  return std::move(written_);
}

bool BitCoder::exhausted() const { return next_ > bytes_.size() + kWindowBytes; }

bool BitCoder::AtEnd() const { return !exhausted() && next_ >= bytes_.size(); }

}  // namespace trailcast::route
