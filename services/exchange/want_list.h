#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "services/base/ids.h"

namespace trailcast::exchange {

// When which missing segment is asked for: lowest first, a bounded number under way, again after a
// timeout that doubles each time. Used by whoever lacks segments, follower or server. What was not
// asked for yet costs memory by the gap, not by the segment.
class WantList {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Options {
    // Silence, not a slow link: while answers come, those behind them are waited for.
    std::chrono::milliseconds retry_after{1000};    // above any round trip with a busy holder
    std::chrono::milliseconds retry_at_most{8000};  // a holder that returns is noticed by then
    // How many are under way at first. It grows by one with each answer that came within
    // `quick_answer`, shrinks by one with each that took longer than `slow_answer`, and is halved
    // when some do not come at all, so that on any link about so much time's worth of segments is
    // queued: nobody who sends them waits for anybody.
    std::size_t first_under_way = 8;
    std::size_t least_under_way = 4;
    std::size_t most_under_way = 1024;  // what one request may carry
    std::chrono::milliseconds quick_answer{250};
    std::chrono::milliseconds slow_answer{500};
  };

  explicit WantList(Options options) : options_(options), window_(options.first_under_way) {}

  // Missing, and worth asking for from `ask_at` on (later than now when it may be coming anyway).
  // Does nothing if it is wanted already.
  void Want(SegmentIndex index, Time ask_at);
  // It came: wanted no more.
  void Arrived(SegmentIndex index, Time now);
  // Segments from `end` on are wanted no more.
  void Truncate(std::uint32_t end);
  // What came was bad: ask again at once the first time, then by the usual timeouts.
  void AskAgain(SegmentIndex index, Time now);
  // A holder has shown up: what was asked for in vain is asked for again at once.
  void Hurry(Time now);
  void Clear();

  // What is to be asked for now, rising; at most most_under_way, and nothing rather than little, so
  // that requests are few. The caller sends it; it is under way from now on.
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
  // What was asked for at `asked_at` may still come: for `wait`, and longer while answers to what
  // was asked for before and with it do.
  [[nodiscard]] bool IsPatient(Time asked_at, std::chrono::milliseconds wait, Time now) const;
  [[nodiscard]] bool IsUnderWay(const Asked& asked, Time now) const;
  [[nodiscard]] bool IsDueAgain(const Asked& asked, Time now) const;
  void AdjustWindow(std::chrono::nanoseconds round_trip);

  Options options_;
  std::size_t window_;
  std::map<SegmentIndex, Asked> asked_;
  Waitings waiting_;
  std::optional<Time> answered_at_;  // the last answer to any of it
  Time overtaken_before_{};          // what was asked for later than before this has come already
};

}  // namespace trailcast::exchange
