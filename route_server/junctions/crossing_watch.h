#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "route_server/junctions/junction_comparer.h"
#include "services/base/newest_map.h"
#include "services/store/route_store.h"
#include "services/view/view_index.h"

namespace trailcast::server {

// A place at which a teaching scout has come to a known route, looking the same way.
struct Crossing {
  route::RouteInfo teaching{};  // as it was known when it was first looked at
  std::string known{};          // that route's name
  double along_m = 0.0;
};

// Looks for known routes in the last metres of a teaching, as segments are stored. It reports each
// route once until the scout has left it. It works in small parts, and leaves out what exceeds the
// bounds, because strangers may ask for any amount.
class CrossingWatch {
 public:
  static constexpr std::size_t kMostTeachings = 64;  // those that grew last
  static constexpr std::size_t kMostArrived = 256;   // segments that wait
  static constexpr std::size_t kLast = 12;           // segments of a teaching that count

  // All three must outlive it.
  CrossingWatch(store::RouteStore& store, view::ViewIndex& index, JunctionComparer& comparer);
  ~CrossingWatch();

  // Notes a stored segment.
  void NoteStored(const route::RouteKey& key, SegmentIndex segment);
  // See JunctionSearch::Step. Routes that cannot be read are left out.
  [[nodiscard]] Result<bool> Step();
  void Handle(const JunctionComparer::Done& done);

  // Returns those since the last call.
  [[nodiscard]] std::vector<Crossing> Take() { return std::exchange(crossings_, {}); }

 private:
  struct Teaching;
  struct Doubt;

  [[nodiscard]] Result<void> LookAt(const route::RouteKey& key, SegmentIndex index);
  void Suspect(Teaching& teaching);
  [[nodiscard]] Result<void> Begin(Doubt& doubt);

  store::RouteStore& store_;
  view::ViewIndex& index_;
  JunctionComparer& comparer_;
  std::deque<std::pair<route::RouteKey, SegmentIndex>> arrived_;
  NewestMap<route::RouteKey, std::shared_ptr<Teaching>> teachings_{kMostTeachings};
  std::vector<Doubt> doubts_;  // the first of them is being examined
  std::vector<Crossing> crossings_;
};

}  // namespace trailcast::server
