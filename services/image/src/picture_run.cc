#include "services/image/picture_run.h"

#include <algorithm>
#include <array>

namespace trailcast::image {

int PictureRun::Reduce(std::uint64_t longer_side_px) {
  constexpr int kMost = 8;
  reduced_ = 1;
  if (enough_px_ <= 0) return reduced_;
  const auto enough_px = static_cast<std::uint64_t>(enough_px_);
  while (reduced_ < kMost && longer_side_px >= 2 * enough_px * static_cast<unsigned>(reduced_)) {
    reduced_ *= 2;
  }
  return reduced_;
}

int PictureRun::Orientation(std::optional<int> told) {
  if (!told) return orientation_.value_or(1);
  if (!orientation_) {
    orientation_ = *told;
    if (*orientation_ != 1) {
      news_.push_back(
          fmt::format("the first picture says that it is to be turned (Exif orientation {}): all "
                      "pictures of this run are turned so",
                      *orientation_));
    }
  }
  if (*told != *orientation_ && !std::exchange(others_told_, true)) {
    news_.push_back(
        fmt::format("a picture says that it is to be turned otherwise than the first (Exif "
                    "orientation {} instead of {}): a robot's camera is fixed, so all pictures of "
                    "this run are turned as the first one",
                    *told, *orientation_));
  }
  return *orientation_;
}

int PictureRun::Bits(int needed) {
  constexpr int kAll = 16;
  constexpr std::array kSensors{10, 12, 14, kAll};
  const auto* const fits =
      std::find_if(kSensors.begin(), kSensors.end(), [&](int bits) { return bits >= needed; });
  const int bits = fits == kSensors.end() ? kAll : *fits;
  if (bits <= bits_) return bits_;
  if (bits_ != 0 || bits != kAll) {
    news_.push_back(fmt::format("pictures use {} of their 16 bits{}: their brightness is by these",
                                bits, bits_ == 0 ? "" : fmt::format(", no longer {}", bits_)));
  }
  bits_ = bits;
  return bits_;
}

Result<void> LeftOutPictures::LeaveOut(const Error& why) {
  ++all_;
  if (count_++ == 0) why_ = why.message;
  if (count_ <= kFew || count_ <= kMostShare * all_) return {};
  return Fail(ErrorCode::kCorrupt, "{}: too many to go on; are they pictures, and written whole?",
              Text());
}

std::string LeftOutPictures::Text() const {
  return fmt::format("{} of {} pictures cannot be read (the first: {})", count_, all_, why_);
}

}  // namespace trailcast::image
