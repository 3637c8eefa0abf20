#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "services/base/ids.h"

namespace trailcast::exchange {

// When which missing segment is asked for: lowest first, a bounded number under way, again after a
// timeout that doubles each time. Used by whoever lacks segments, follower or server.
class WantList {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Options {
    std::chrono::milliseconds retry_after{1000};    // above any round trip with a busy holder
    std::chrono::milliseconds retry_at_most{8000};  // a holder that returns is noticed by then
    std::size_t max_under_way = 128;                // about 0.5 MB of segments
  };

  explicit WantList(Options options) : options_(options) {}

  // Missing, and worth asking for from `ask_at` on (later than now when it may be coming anyway).
  // Does nothing if it is wanted already.
  void Want(SegmentIndex index, Time ask_at);
  // Arrived: wanted no more.
  void Remove(SegmentIndex index) { wanted_.erase(index); }
  // What came was bad: ask again at once the first time, then by the usual timeouts.
  void AskAgain(SegmentIndex index, Time now);
  // A holder has shown up: what was asked for in vain is asked for again at once.
  void Hurry(Time now);
  void Clear() { wanted_.clear(); }

  // What is to be asked for now. The caller sends it; it is under way from now on.
  [[nodiscard]] std::vector<SegmentIndex> Due(Time now);

  [[nodiscard]] bool empty() const { return wanted_.empty(); }
  [[nodiscard]] bool contains(SegmentIndex index) const { return wanted_.contains(index); }
  [[nodiscard]] std::optional<SegmentIndex> first() const;
  [[nodiscard]] std::optional<SegmentIndex> last() const;
  [[nodiscard]] std::size_t size() const { return wanted_.size(); }

 private:
  struct Entry {
    Time ask_at;
    std::optional<Time> asked_at;
    int times_asked = 0;
  };

  [[nodiscard]] bool IsUnderWay(const Entry& want, Time now) const;

  Options options_;
  std::map<SegmentIndex, Entry> wanted_;
};

}  // namespace trailcast::exchange
