#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "route_server/junctions/crossing_watch.h"
#include "route_server/junctions/junction_comparer.h"
#include "route_server/junctions/junction_search.h"
#include "services/catalog/view_catalog.h"

namespace trailcast::server {

// Looks for junctions beside the server's other work. It reads the store and the index of views in
// turns of some milliseconds, and compares on a thread of its own.
class JunctionFinder {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Both must outlive it. See JunctionSearch for `was_searched`.
  JunctionFinder(store::RouteStore& store, catalog::ViewCatalog& views,
                 std::function<bool(const route::RouteKey&)> was_searched);

  void Note(const route::RouteInfo& info) { search_.Note(info); }
  void NoteStored(const route::RouteKey& key, SegmentIndex segment) {
    crossings_.NoteStored(key, segment);
  }
  // Works for one of four milliseconds, if a turn is due. An error is the store's, or kInternal if
  // a fault of the program kept a comparison from finding junctions.
  [[nodiscard]] Result<void> Turn(Time now);
  // Returns when the next turn is due, or nothing while there is nothing to do.
  [[nodiscard]] std::optional<Time> due() const {
    return busy_ ? std::optional(due_) : std::nullopt;
  }

  [[nodiscard]] std::vector<Meeting> TakeMeetings() { return search_.TakeMeetings(); }
  [[nodiscard]] std::vector<route::RouteKey> TakeSearched() { return search_.TakeSearched(); }
  [[nodiscard]] std::vector<Crossing> TakeCrossings() { return crossings_.Take(); }

 private:
  // Scouts wait for crossings, so these come first.
  [[nodiscard]] Result<bool> Step();

  catalog::ViewCatalog& views_;
  JunctionComparer comparer_;
  JunctionSearch search_;
  CrossingWatch crossings_;
  Time due_{};
  bool busy_ = false;
};

}  // namespace trailcast::server
