#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace trailcast::agent {

// How long a fetch will take, from what came lately: a link that has become slower or was cut for a
// while is judged by what it does now.
class FetchEstimate {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLately{10};

  explicit FetchEstimate(Time began) : marks_{{began, 0}} {}

  // So many segments have come since the beginning; what was held before it does not count.
  void Note(Time now, std::uint32_t fetched) {
    marks_.push_back({now, fetched});
    while (marks_.size() > 2 && marks_[1].at <= now - kLately) marks_.pop_front();
  }

  // For so many segments more; empty if none came lately.
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
