#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/exchange/messages.h"
#include "services/store/route_store.h"

namespace trailcast::soak {

// This is everything that servers ever acknowledged, of revisions that no operator has deleted
// since. It must be on the server's disk from then on, byte for byte.
class Ledger {
 public:
  void Note(const exchange::Receipt& receipt);
  // Records what its scout taught, read from the scout's own store.
  void NoteTaught(const route::RouteKey& key, std::vector<route::SegmentPiece> pieces);
  // Notes that an operator asks for its deletion: from now on it need not be there.
  void Forget(const route::RouteKey& key);
  // Notes that the server said that it is deleted: from now on it must not be there.
  void NoteDeleted(const route::RouteKey& key) { deleted_.insert(key); }

  [[nodiscard]] const std::vector<route::SegmentPiece>& TaughtOf(const route::RouteKey& key) const {
    return taught_.at(key);
  }

  // Returns a line for each acknowledged segment that the store lacks, has damaged, or has
  // otherwise than it was taught. A segment that was never acknowledged may be missing.
  [[nodiscard]] std::vector<std::string> LostIn(store::RouteStore& store);

  // Returns a line for each deleted revision of which the store still, or again, has segments.
  [[nodiscard]] std::vector<std::string> UndeletedIn(store::RouteStore& store) const;

  // These are the segments acknowledged so far, and how often one of them was checked.
  [[nodiscard]] std::size_t receipted() const { return receipted_; }
  [[nodiscard]] std::size_t checked() const { return checked_; }

 private:
  void NoteSegment(const route::RouteKey& key, SegmentIndex index);

  std::map<route::RouteKey, std::set<SegmentIndex>> durable_;
  std::map<route::RouteKey, std::vector<route::SegmentPiece>> taught_;
  std::set<route::RouteKey> forgotten_;
  std::set<route::RouteKey> deleted_;
  std::size_t receipted_ = 0;
  std::size_t checked_ = 0;
};

}  // namespace trailcast::soak
