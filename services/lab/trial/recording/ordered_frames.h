#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/image/files.h"
#include "services/lab/trial/recording/judge.h"

namespace trailcast::trial {

// Returns how many frames a recording (a folder of pictures or a video) has. Videos have to be read
// for that.
[[nodiscard]] Result<int> CountFrames(const std::filesystem::path& recording);

// A recording's frames in another order. A forward order is read on demand; any other keeps its
// frames in memory. The next readable frame replaces one that cannot be read, so that frames keep
// their numbers.
class OrderedFrames {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{1} << 30U;  // kept in memory

  // `enough_px` is that of image::PictureRun. kInvalidArgument means that more would have to be
  // kept.
  [[nodiscard]] static Result<OrderedFrames> Open(const std::filesystem::path& recording,
                                                  std::vector<Shown> order, int enough_px = 0);

  // Returns the next frame, or nothing at the end of the order. Errors are FrameSequence's.
  [[nodiscard]] Result<std::optional<image::GrayImage>> Next();

  [[nodiscard]] const std::vector<Shown>& order() const { return order_; }
  // See FrameSequence.
  [[nodiscard]] std::vector<std::string> TakeNews() { return frames_->TakeNews(); }

 private:
  OrderedFrames(std::unique_ptr<image::FrameSequence> frames, std::vector<Shown> order)
      : frames_(std::move(frames)), order_(std::move(order)) {}
  [[nodiscard]] Result<void> ReadOn(int frame);
  [[nodiscard]] Result<void> KeepAll(const std::filesystem::path& recording);

  std::unique_ptr<image::FrameSequence> frames_;
  std::vector<Shown> order_;
  std::size_t next_ = 0;                // in order_
  int read_ = 0;                        // frames of the recording, including those left out
  image::GrayImage current_;            // the last one read
  std::vector<image::GrayImage> kept_;  // by frame; those that are not shown are empty
};

}  // namespace trailcast::trial
