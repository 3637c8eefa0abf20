#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "route_server/joints/crossing_watch.h"
#include "route_server/joints/joint_comparer.h"
#include "route_server/joints/joint_search.h"
#include "services/catalog/view_catalog.h"

namespace trailcast::server {

// Where routes meet, looked for beside all else that a server does: what has to read the store or
// the index of views in turns of some milliseconds, the comparing on a thread of its own.
class JointDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Both outlive it. `was_searched`: as JointSearch has it.
  JointDesk(store::RouteStore& store, catalog::ViewCatalog& views,
            std::function<bool(const route::RouteKey&)> was_searched);

  void Note(const route::RouteInfo& info) { search_.Note(info); }
  void NoteStored(const route::RouteKey& key, SegmentIndex segment) {
    crossings_.NoteStored(key, segment);
  }
  // A turn, if one is due: of four milliseconds one is worked. An error is the store's, or
  // kInternal: what was compared has no joints for a fault of the program.
  [[nodiscard]] Result<void> Turn(Time now);
  // When the next turn is due; nothing while there is nothing to do in it.
  [[nodiscard]] std::optional<Time> due() const {
    return busy_ ? std::optional(due_) : std::nullopt;
  }

  [[nodiscard]] std::vector<Meeting> TakeMeetings() { return search_.TakeMeetings(); }
  [[nodiscard]] std::vector<route::RouteKey> TakeSearched() { return search_.TakeSearched(); }
  [[nodiscard]] std::vector<Crossing> TakeCrossings() { return crossings_.Take(); }

 private:
  // What a scout waits for comes first.
  [[nodiscard]] Result<bool> Step();

  catalog::ViewCatalog& views_;
  JointComparer comparer_;
  JointSearch search_;
  CrossingWatch crossings_;
  Time due_{};
  bool busy_ = false;
};

}  // namespace trailcast::server
