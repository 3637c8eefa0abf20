#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::exchange {

// Which segments were asked for and are to be sent. What several agents ask for within a short
// window is sent once, by multicast; repeated requests for what is queued cost nothing.
class AnswerQueue {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit AnswerQueue(std::chrono::milliseconds window) : window_(window) {}

  void Ask(const route::RouteKey& key, std::span<const SegmentIndex> indices, Time now);

  using ReadPiece =
      std::function<Result<route::SegmentPiece>(const route::RouteKey&, SegmentIndex)>;
  struct Unreadable {
    route::RouteKey key;
    SegmentIndex index;
    Error error;
  };
  struct Answers {
    std::vector<route::SegmentPiece> pieces;  // of each route, lowest index first
    std::vector<Unreadable> unreadable;       // asked for, but `read` failed: not sent
  };
  // What is to be sent now, from the routes whose window has passed: up to `max_bytes`, and the
  // rest the next time.
  [[nodiscard]] Answers Due(Time now, std::size_t max_bytes, const ReadPiece& read);

  [[nodiscard]] bool empty() const { return asked_.empty(); }

 private:
  struct Asked {
    Time since;
    std::set<SegmentIndex> indices;
  };
  std::chrono::milliseconds window_;
  std::map<route::RouteKey, Asked> asked_;
};

}  // namespace trailcast::exchange
