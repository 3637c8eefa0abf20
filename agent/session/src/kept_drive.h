#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "agent/session/observation.h"

namespace trailcast::agent {

// This keeps what a scout has seen since it began, for as long as it may have to be taught again:
// at most ten pictures a second, of a robot that moves.
class KeptDrive {
 public:
  struct Frame {
    int number = 0;
    Observation seen;
  };

  explicit KeptDrive(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  void Add(int number, Observation seen);
  // Returns false if it exceeded the bound and was dropped.
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] std::deque<Frame> Take() { return std::move(frames_); }

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  bool whole_ = true;
  std::deque<Frame> frames_;
  std::vector<motion::ImuSample> imu_;  // since the last frame that was kept
};

}  // namespace trailcast::agent
