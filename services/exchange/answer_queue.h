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

// Which segments were asked for and are to be sent. What several agents ask for is sent once, by
// multicast: together with what others ask for within a short window, and not again for a while
// after, in which it is on its way to all of them. Who did not get it asks once more, later.
class AnswerQueue {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Options {
    // The first who ask for a route after a pause are waited for together.
    std::chrono::milliseconds window{10};
    // Below WantList's retry_after, so that whoever asks again is answered.
    std::chrono::milliseconds on_its_way{800};
    // A link that took nothing is tried again after this.
    std::chrono::milliseconds again_after{50};
    // Segments that are remembered, of all routes: 15 MB. What is asked for beyond has to be asked
    // for again.
    std::size_t most{100'000};
  };

  explicit AnswerQueue(Options options) : options_(options) {}

  void Ask(const route::RouteKey& key, std::span<const SegmentIndex> indices, Time now);
  // It was due and could not be handed over: asked for as before, and not on its way.
  void PutBack(const route::RouteKey& key, SegmentIndex index, Time now);

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
  // rest the next time, when another route is the first.
  [[nodiscard]] Answers Due(Time now, std::size_t max_bytes, const ReadPiece& read);

  // Nothing is to be sent, now or soon.
  [[nodiscard]] bool empty() const;
  // Due would return something.
  [[nodiscard]] bool IsDue(Time now) const;

 private:
  struct Asked {
    Time due_at{};
    std::set<SegmentIndex> indices;
    std::map<SegmentIndex, Time> sent;
    Time sent_last{};
  };
  [[nodiscard]] bool IsOnItsWay(Time sent, Time now) const {
    return now < sent + options_.on_its_way;
  }

  [[nodiscard]] bool HasRoom(Time now);

  Options options_;
  std::map<route::RouteKey, Asked> asked_;
  std::size_t remembered_ = 0;  // segments in asked_
  Time cleared_at_{};           // of what is no longer on its way
  route::RouteKey served_last_;
};

}  // namespace trailcast::exchange
