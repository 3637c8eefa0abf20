#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "route_server/joints/joint_comparer.h"
#include "services/base/newest_map.h"
#include "services/store/route_store.h"
#include "services/view/view_index.h"

namespace trailcast::server {

// A scout that teaches has come to a place of a known route, looking the same way.
struct Crossing {
  route::RouteInfo teaching{};  // as it was known when it was first looked at
  std::string known{};          // that route's name
  double along_m = 0.0;
};

// Looks for known routes in the last metres of what is being taught, as segments are stored: tells
// of each once, until the scout has left it. A small part at a time; what is more than strangers
// may ask for is left out.
class CrossingWatch {
 public:
  static constexpr std::size_t kMostTeachings = 64;  // those that grew last
  static constexpr std::size_t kMostArrived = 256;   // segments that wait to be looked at
  static constexpr std::size_t kLast = 12;           // segments of a teaching that count

  // All outlive it.
  CrossingWatch(store::RouteStore& store, view::ViewIndex& index, JointComparer& comparer);
  ~CrossingWatch();

  // A segment was stored.
  void NoteStored(const route::RouteKey& key, SegmentIndex segment);
  // As JointSearch::Step; what cannot be read is left out.
  [[nodiscard]] Result<bool> Step();
  void Handle(const JointComparer::Done& done);

  // Since the last call.
  [[nodiscard]] std::vector<Crossing> Take() { return std::exchange(crossings_, {}); }

 private:
  struct Teaching;
  struct Doubt;

  [[nodiscard]] Result<void> LookAt(const route::RouteKey& key, SegmentIndex index);
  void Suspect(Teaching& teaching);
  [[nodiscard]] Result<void> Begin(Doubt& doubt);

  store::RouteStore& store_;
  view::ViewIndex& index_;
  JointComparer& comparer_;
  std::deque<std::pair<route::RouteKey, SegmentIndex>> arrived_;
  NewestMap<route::RouteKey, std::shared_ptr<Teaching>> teachings_{kMostTeachings};
  std::vector<Doubt> doubts_;  // that wait, the first of them is seen to
  std::vector<Crossing> crossings_;
};

}  // namespace trailcast::server
