#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace trailcast::agent {

// Estimates how long a fetch will take. It goes by recent progress, so that a link that became
// slower or was cut for a while is judged by its present speed.
class FetchEstimate {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLately{10};

  explicit FetchEstimate(Time began) : marks_{{began, 0}} {}

  // Notes that so many segments have come since the beginning, without those that were held before.
  void Note(Time now, std::uint32_t fetched) {
    marks_.push_back({now, fetched});
    while (marks_.size() > 2 && marks_[1].at <= now - kLately) marks_.pop_front();
  }

  // Returns the time for so many more segments, or nothing if none came lately.
  [[nodiscard]] std::optional<std::chrono::duration<double>> Left(std::uint32_t missing) const {
    const Mark& from = marks_.front();
    const Mark& to = marks_.back();
    if (to.fetched == from.fetched) return std::nullopt;
    const std::chrono::duration<double> took = to.at - from.at;
    return took / (to.fetched - from.fetched) * missing;
  }

 private:
  struct Mark {
    Time at;
    std::uint32_t fetched = 0;
  };
  std::deque<Mark> marks_;
};

}  // namespace trailcast::agent
