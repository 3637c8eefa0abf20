#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"

namespace trailcast::image {

// The properties that all pictures of one camera's run share, so that how a picture is written down
// never makes it look different from the one before. A single picture is a run of one.
class PictureRun {
 public:
  // The pictures' reader reduces their longer side to `enough_px`. A JPEG is decoded to a
  // half, a quarter or an eighth of its size as long as that much is left. With 0 none is reduced.
  explicit PictureRun(int enough_px = 0) : enough_px_(enough_px) {}

  // Returns how many times smaller a JPEG with such a longer side is decoded: 1, 2, 4 or 8.
  [[nodiscard]] int Reduce(std::uint64_t longer_side_px);
  // Returns how many times the decoded width and height the camera's last picture has.
  [[nodiscard]] int reduced() const { return reduced_; }

  // Returns how the next picture is to be turned, 1 to 8 as Exif numbers it (1: not at all), where
  // that picture itself says `told`, or nothing. The first picture that says something decides,
  // because a robot's camera is fixed, while phones write into each picture how they believe to be
  // held and change their mind on the way.
  [[nodiscard]] int Orientation(std::optional<int> told);

  // Returns how many of a picture's 16 bits are a pixel's, if its brightest pixel needs `needed`:
  // sensors have 10, 12, 14 or 16. The number never falls during a run.
  [[nodiscard]] int Bits(int needed);

  // Returns lines for people about what was found out, each once.
  [[nodiscard]] std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  int enough_px_;
  int reduced_ = 1;
  std::optional<int> orientation_;
  bool others_told_ = false;
  int bits_ = 0;
  std::vector<std::string> news_;
};

// Counts the pictures of a run that cannot be read. They are left out as long as they are few.
class LeftOutPictures {
 public:
  void Read() { ++all_; }
  // Counts one picture more. The error is kCorrupt, whatever the code of `why`: too many are left
  // out.
  [[nodiscard]] Result<void> LeaveOut(const Error& why);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::string& why() const { return why_; }  // of the first one
  // Returns text for people: "2 of 40 pictures cannot be read (the first: ...)".
  [[nodiscard]] std::string Text() const;

  // A failing memory card or a bad link loses some pictures. A run that loses more than this is no
  // run any more.
  static constexpr int kFew = 10;
  static constexpr double kMostShare = 0.1;

 private:
  int all_ = 0;
  int count_ = 0;
  std::string why_;
};

}  // namespace trailcast::image
