#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "route_server/routes/store_watch.h"
#include "services/catalog/orphans.h"
#include "services/catalog/partial_routes.h"
#include "services/exchange/route_keeper.h"

namespace trailcast::server {

// Looks after the store without being asked: it checks that the store is there, that complete
// routes lack nothing, and that there are no orphaned segments. It does a part at a time.
class Upkeep {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Both must outlive it.
  Upkeep(store::RouteStore& store, exchange::RouteKeeper& keeper)
      : keeper_(keeper), watch_(store), partial_(store), orphans_(store) {}

  // Works at most once a second, and writes to the log.
  void Tick(Time now);
  void NoteDamaged(const route::RouteKey& key, SegmentIndex segment) {
    partial_.NoteDamaged(key, segment);
  }
  void NoteStored(const route::RouteKey& key, SegmentIndex segment) {
    partial_.NoteStored(key, segment);
  }

  // Returns why the store cannot be used, or an empty text.
  [[nodiscard]] const std::string& store_trouble() const { return watch_.trouble(); }
  [[nodiscard]] std::size_t partial_routes() const { return partial_.routes(); }
  [[nodiscard]] std::size_t lacking_segments() const { return partial_.segments(); }
  // Returns which of these routes are served only in part.
  [[nodiscard]] std::vector<exchange::LackingSegments> LackingOf(
      const std::vector<route::RouteInfo>& routes) const;
  [[nodiscard]] std::uint64_t dropped_orphans() const { return dropped_orphans_; }  // segments
  // Returns "2 routes lack 5 segments here", or an empty text.
  [[nodiscard]] std::string Degraded() const;

 private:
  [[nodiscard]] Result<void> SeeToRoutes(Time now);
  [[nodiscard]] Result<void> SeeToOrphans(Time now);

  exchange::RouteKeeper& keeper_;
  StoreWatch watch_;
  catalog::PartialRoutes partial_;
  catalog::Orphans orphans_;
  std::uint64_t dropped_orphans_ = 0;
  Time due_{};
  std::string told_;  // the last thing that went wrong
};

}  // namespace trailcast::server
