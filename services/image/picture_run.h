#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"

namespace trailcast::image {

// What holds for all pictures of one run of one camera, so that none looks otherwise than the one
// before only because of how it is written down. Of a single picture: a run of one.
class PictureRun {
 public:
  // Which way the next picture is to be turned, 1 to 8 as Exif numbers them (1: not at all). Phones
  // write into each picture how they believe to be held, and change their mind on the way; a
  // robot's camera is fixed. So the first picture's word holds.
  [[nodiscard]] int Orientation(std::span<const std::uint8_t> picture);

  // How many of a picture's 16 bits a pixel's are, where this one's brightest needs `needed`:
  // sensors have 10, 12, 14 or 16. Never fewer than of the picture before.
  [[nodiscard]] int Bits(int needed);

  // Lines for people, once each: what was found out.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  std::optional<int> orientation_;
  bool others_told_ = false;
  int bits_ = 0;
  std::vector<std::string> news_;
};

// The pictures of a run that cannot be read: they are left out, as long as they are few.
class LeftOutPictures {
 public:
  void Read() { ++all_; }
  // Whatever the code of `why`, the error is kCorrupt: too many are left out.
  [[nodiscard]] Result<void> LeaveOut(const Error& why);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::string& why() const { return why_; }  // of the first
  // For people: "2 of 40 pictures cannot be read (the first: ...)".
  [[nodiscard]] std::string Text() const;

  // A memory card that fails, a link that loses: more is no run any more.
  static constexpr int kFew = 10;
  static constexpr double kMostShare = 0.1;

 private:
  int all_ = 0;
  int count_ = 0;
  std::string why_;
};

}  // namespace trailcast::image
