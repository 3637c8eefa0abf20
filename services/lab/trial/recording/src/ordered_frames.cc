#include "services/lab/trial/recording/ordered_frames.h"

#include <algorithm>
#include <utility>

#include "services/lab/trial/recording/frame_order.h"

namespace trailcast::trial {

Result<int> CountFrames(const std::filesystem::path& recording) {
  auto frames = image::FrameSequence::Open(recording);
  if (!frames) return tl::unexpected(frames.error());
  // Videos announce their length only roughly.
  const auto size = (*frames)->size();
  if (size && std::filesystem::is_directory(recording)) return *size;
  for (int count = 0;; ++count) {
    auto frame = (*frames)->Next();
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) return count;
  }
}

Result<OrderedFrames> OrderedFrames::Open(const std::filesystem::path& recording,
                                          std::vector<Shown> order, int enough_px) {
  auto frames = image::FrameSequence::Open(recording, enough_px);
  if (!frames) return tl::unexpected(frames.error());
  const bool forward = GoesForward(order);
  OrderedFrames ordered(std::move(*frames), std::move(order));
  if (!forward) {
    if (auto kept = ordered.KeepAll(recording); !kept) return tl::unexpected(kept.error());
  }
  return ordered;
}

Result<void> OrderedFrames::KeepAll(const std::filesystem::path& recording) {
  int last = 0;
  for (const Shown& shown : order_) last = std::max(last, shown.frame);
  std::vector<bool> wanted(static_cast<std::size_t>(last) + 1, false);
  for (const Shown& shown : order_) wanted[static_cast<std::size_t>(shown.frame)] = true;
  kept_.resize(wanted.size());
  std::size_t bytes = 0;
  for (int frame = 0; frame <= last; ++frame) {
    if (auto read = ReadOn(frame); !read) return read;
    if (!wanted[static_cast<std::size_t>(frame)]) continue;
    bytes += current_.pixels.size();
    if (bytes > kMostBytes) {
      return Fail(ErrorCode::kInvalidArgument,
                  "{} is too long to be shown in another order: {} of its frames are more than "
                  "the {} MB that are kept in memory; give a part of it",
                  recording.string(), frame + 1, kMostBytes >> 20U);
    }
    kept_[static_cast<std::size_t>(frame)] = current_;
  }
  return {};
}

// Reads until `frame` is the current one.
Result<void> OrderedFrames::ReadOn(int frame) {
  while (read_ <= frame) {
    auto next = frames_->Next();
    if (!next) return tl::unexpected(next.error());
    const bool last_left_out = read_ > 0 && frame < frames_->size().value_or(0);
    if (!*next && last_left_out) {
      read_ = frame + 1;
      return {};
    }
    if (!*next) {
      return Fail(ErrorCode::kCorrupt, "the recording ends before frame {}, at frame {}", frame,
                  read_);
    }
    current_ = std::move(**next);
    read_ = frames_->number() + 1;
  }
  return {};
}

Result<std::optional<image::GrayImage>> OrderedFrames::Next() {
  if (next_ == order_.size()) return std::nullopt;
  const int frame = order_[next_].frame;
  ++next_;
  if (!kept_.empty()) return kept_[static_cast<std::size_t>(frame)];
  if (auto read = ReadOn(frame); !read) return tl::unexpected(read.error());
  return current_;
}

}  // namespace trailcast::trial
