#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace trailcast::agent {

// Estimates how long a fetch will take. It goes by recent progress, so that a link that became
// slower or was cut for a while is judged by its present speed. The time before the first segment
// counts for nothing: a server was looked for meanwhile.
class FetchEstimate {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLately{10};

  // Notes that so many segments have come since the beginning, without those that were held before.
  void Note(Time now, std::uint32_t fetched) {
    if (fetched == 0) return;
    marks_.push_back({now, fetched});
    while (marks_.size() > 2 && marks_[1].at <= now - kLately) marks_.pop_front();
  }

  // Returns the time for so many more segments, or nothing if too few came lately to tell.
  [[nodiscard]] std::optional<std::chrono::duration<double>> Left(std::uint32_t missing) const {
    if (marks_.empty()) return std::nullopt;
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
