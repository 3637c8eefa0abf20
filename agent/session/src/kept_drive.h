#pragma once

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "agent/session/observation.h"

namespace trailcast::agent {

// What a scout has seen since it began, for as long as that may have to be taught again: ten
// pictures a second at most, of a robot that moves.
class KeptDrive {
 public:
  struct Frame {
    int number = 0;
    Observation seen;
  };

  explicit KeptDrive(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  void Add(int number, Observation seen);
  // False: it was more than may be kept, and is gone.
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] std::deque<Frame> Take() { return std::move(frames_); }

 private:
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  bool whole_ = true;
  std::deque<Frame> frames_;
  std::vector<motion::ImuSample> imu_;  // since the last one that was kept
};

}  // namespace trailcast::agent
