#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "services/base/ids.h"

namespace trailcast::exchange {

// This decides when to ask for which missing segment: the lowest first, a bounded number under way,
// and again after a timeout that doubles each time. Followers and servers use it alike. Segments
// that were not asked for yet cost memory by the gap, not by the segment.
class WantList {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Options {
    // These are for silence, not for a slow link: while answers come, it waits for the ones behind
    // them.
    std::chrono::milliseconds retry_after{1000};  // above any round trip with a busy holder
    // A holder that returns is noticed within this time.
    std::chrono::milliseconds retry_at_most{8000};
    // So many are under way at first. The number grows by one with each answer within
    // `quick_answer`, shrinks by one with each that took longer than `slow_answer`, and is halved
    // when some do not come at all. So on any link the queue holds segments for about that much
    // time, and the sender's other readers do not wait.
    std::size_t first_under_way = 8;
    std::size_t least_under_way = 4;
    std::size_t most_under_way = 1024;  // one request carries no more
    std::chrono::milliseconds quick_answer{250};
    std::chrono::milliseconds slow_answer{500};
  };

  explicit WantList(Options options) : options_(options), window_(options.first_under_way) {}

  // Wants a missing segment, to be asked for from `ask_at` on (later than now if it may be coming
  // anyway). Does nothing if it is wanted already.
  void Want(SegmentIndex index, Time ask_at);
  // Notes that it came: it is no longer wanted.
  void Arrived(SegmentIndex index, Time now);
  // Segments from `end` on are no longer wanted.
  void Truncate(std::uint32_t end);
  // Notes that the bytes that came were bad. It is asked for again at once the first time, then
  // after the usual timeouts.
  void AskAgain(SegmentIndex index, Time now);
  // A holder has appeared, so segments that were asked for in vain are asked for again at once.
  void Hurry(Time now);
  void Clear();

  // Returns the segments to ask for now, rising, at most most_under_way. It returns nothing rather
  // than few, so that requests are few. The caller sends the request; the segments are under way
  // from now on.
  [[nodiscard]] std::vector<SegmentIndex> Due(Time now);

  [[nodiscard]] bool empty() const { return asked_.empty() && waiting_.empty(); }
  [[nodiscard]] bool contains(SegmentIndex index) const;
  [[nodiscard]] std::optional<SegmentIndex> first() const;
  [[nodiscard]] std::size_t size() const;

 private:
  struct Asked {
    Time at;
    int times = 1;
    bool again_now = false;
  };
  struct Waiting {  // not asked for yet: segments from the key on
    std::uint32_t end;
    Time ask_at;
  };
  using Waitings = std::map<std::uint32_t, Waiting>;

  [[nodiscard]] Waitings::const_iterator FindWaiting(std::uint32_t index) const;
  bool StopWaiting(std::uint32_t index);
  // Tells that what was asked for at `asked_at` may still come: for `wait`, and for longer while
  // answers to earlier and simultaneous requests come.
  [[nodiscard]] bool IsPatient(Time asked_at, std::chrono::milliseconds wait, Time now) const;
  [[nodiscard]] bool IsUnderWay(const Asked& asked, Time now) const;
  [[nodiscard]] bool IsDueAgain(const Asked& asked, Time now) const;
  void AdjustWindow(std::chrono::nanoseconds round_trip);

  Options options_;
  std::size_t window_;
  std::map<SegmentIndex, Asked> asked_;
  Waitings waiting_;
  std::optional<Time> answered_at_;  // when any of it was last answered
  Time overtaken_before_{};  // the newest request that was answered; older ones are overtaken
};

}  // namespace trailcast::exchange
