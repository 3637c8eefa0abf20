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

// This holds the segments that were asked for and are still to be sent. A segment that several
// agents ask for is sent once, by multicast: a short window collects their requests, and a segment
// that was just sent is on its way to all of them, so it is not sent again for a while. An agent
// that did not get it asks once more, later.
class AnswerQueue {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Options {
    // A short wait collects the first requests for a route after a pause.
    std::chrono::milliseconds window{10};
    // This is below WantList's retry_after, so that an agent that asks again is answered.
    std::chrono::milliseconds on_its_way{800};
    // A link that took nothing is tried again after this.
    std::chrono::milliseconds again_after{50};
    // The queue remembers at most so many segments of all routes, 15 MB. An agent has to ask again
    // for those beyond.
    std::size_t most{100'000};
  };

  explicit AnswerQueue(Options options) : options_(options) {}

  void Ask(const route::RouteKey& key, std::span<const SegmentIndex> indices, Time now);
  // Puts back a segment that was due and could not be handed over: it is asked for as before, and
  // not on its way.
  void PutBack(const route::RouteKey& key, SegmentIndex index, Time now);

  using ReadPiece =
      std::function<Result<route::SegmentPiece>(const route::RouteKey&, SegmentIndex)>;
  struct Unreadable {
    route::RouteKey key;
    SegmentIndex index;
    Error error;
  };
  struct Answers {
    std::vector<route::SegmentPiece> pieces;  // of each route, the lowest index first
    std::vector<Unreadable> unreadable;       // `read` failed for these, so they are not sent
  };
  // Returns what has to be sent now, at most `max_bytes`, from the routes whose window has passed.
  // The next call returns the rest and begins with another route.
  [[nodiscard]] Answers Due(Time now, std::size_t max_bytes, const ReadPiece& read);

  // Tells that nothing has to be sent, now or soon.
  [[nodiscard]] bool empty() const;
  // Tells that Due would return something.
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
  Time cleared_at_{};           // when segments that are no longer on their way were last removed
  route::RouteKey served_last_;
};

}  // namespace trailcast::exchange
