#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "services/base/ids.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This is a route as far as it is known.
class KnownRoute {
 public:
  // `announced` is the announced number of its segments.
  explicit KnownRoute(std::size_t announced) : announced_(announced) {}

  void Add(route::Segment segment) {
    begin_m_.push_back(length_m());
    segments_.push_back(std::move(segment));
  }
  void MarkComplete() { complete_ = true; }

  [[nodiscard]] const std::vector<route::Segment>& segments() const { return segments_; }
  [[nodiscard]] const route::Segment& segment(SegmentIndex index) const {
    return segments_[index.value()];
  }
  [[nodiscard]] bool has(std::size_t index) const { return index < segments_.size(); }
  [[nodiscard]] bool is_last(SegmentIndex index) const {
    return complete_ && index.value() + 1 == segments_.size();
  }
  // Returns the turn on the spot after the segment, or 0 if there is none or nothing is known of
  // what follows.
  [[nodiscard]] double turn_after_rad(SegmentIndex index) const {
    const std::size_t next = index.value() + 1;
    return has(next) ? segments_[next].turn_before_rad : 0.0;
  }
  // Tells that the direction of driving changes after the segment, to backwards or forwards.
  [[nodiscard]] bool reverses_after(SegmentIndex index) const {
    const std::size_t next = index.value() + 1;
    return has(next) && segments_[next].reverse != segments_[index.value()].reverse;
  }
  // Tells that it is the last one, or that a turn on the spot or a change of direction follows.
  [[nodiscard]] bool stands_after(SegmentIndex index) const {
    return is_last(index) || turn_after_rad(index) != 0.0 || reverses_after(index);
  }
  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] double begin_m(SegmentIndex index) const { return begin_m_[index.value()]; }
  [[nodiscard]] double length_m() const {
    return segments_.empty() ? 0.0 : begin_m_.back() + segments_.back().length_m;
  }
  // Returns a share of the announced route, by segments.
  [[nodiscard]] double ProgressAt(SegmentIndex segment, double fraction) const {
    return (segment.value() + fraction) /
           static_cast<double>(std::max(segments_.size(), announced_));
  }

 private:
  std::size_t announced_;
  std::vector<route::Segment> segments_;
  std::vector<double> begin_m_;
  bool complete_ = false;
};

// A robot that turned further than this on the spot sees next to nothing of what it saw before.
// Without odometry it cannot tell how far it has turned.
inline constexpr double kTurnsAway_rad = 0.5;

}  // namespace trailcast::agent
