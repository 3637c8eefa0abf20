#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "route_server/junctions/junction_comparer.h"
#include "route_server/junctions/meeting.h"
#include "services/store/route_store.h"
#include "services/view/view_index.h"

namespace trailcast::server {

// Looks for places where a revision that robots follow meets others, or itself. It searches each
// revision once, including those in the store at the start. The index of views tells which routes
// are worth comparing. It works in small parts.
class JunctionSearch {
 public:
  static constexpr std::size_t kMostNearRoutes = 20;

  // All must outlive it. `was_searched` tells what earlier runs have done.
  JunctionSearch(store::RouteStore& store, view::ViewIndex& index, JunctionComparer& comparer,
                 std::function<bool(const route::RouteKey&)> was_searched);
  ~JunctionSearch();

  // Notes that the knowledge of a revision may have changed.
  void Note(const route::RouteInfo& info);
  // Reads a segment, or queries the index for a view. Returns false if there is nothing to do, or a
  // comparison is running. An error is the store's; that search is left out or, if it is
  // kUnavailable, begins anew later.
  [[nodiscard]] Result<bool> Step();
  void Handle(const JunctionComparer::Done& done);

  // Returns those since the last call.
  [[nodiscard]] std::vector<Meeting> TakeMeetings() { return std::exchange(meetings_, {}); }
  // Returns the revisions whose meetings are complete. Take these after the meetings.
  [[nodiscard]] std::vector<route::RouteKey> TakeSearched() { return std::exchange(searched_, {}); }

 private:
  struct Search;

  [[nodiscard]] Result<bool> TryStep();
  [[nodiscard]] Result<void> ReadPage();
  [[nodiscard]] Result<void> Begin(const route::RouteKey& key);
  [[nodiscard]] Result<void> Read(Search& search);
  [[nodiscard]] Result<void> StepToNear(Search& search);
  void Compare(Search& search, JunctionComparer::Views other, const route::RouteInfo& of);

  store::RouteStore& store_;
  view::ViewIndex& index_;
  JunctionComparer& comparer_;
  std::function<bool(const route::RouteKey&)> was_searched_;

  std::string cursor_;  // of the walk through the store
  bool walked_ = false;
  std::deque<route::RouteKey> waiting_;
  std::unique_ptr<Search> search_;

  std::vector<Meeting> meetings_;
  std::vector<route::RouteKey> searched_;
};

}  // namespace trailcast::server
