#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "route_server/routes/store_watch.h"
#include "services/catalog/partial_routes.h"
#include "services/catalog/strays.h"
#include "services/exchange/route_keeper.h"

namespace trailcast::server {

// What a server sees to in its store although nobody asks: that it is there, that complete routes
// lack nothing, and that no segments lie about of which nothing is known. Some of it at a time.
class Upkeep {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Both outlive it.
  Upkeep(store::RouteStore& store, exchange::RouteKeeper& keeper)
      : keeper_(keeper), watch_(store), partial_(store), strays_(store) {}

  // At most once a second. Tells the log.
  void Tick(Time now);
  void NoteDamaged(const route::RouteKey& key, SegmentIndex segment) {
    partial_.NoteDamaged(key, segment);
  }
  void NoteStored(const route::RouteKey& key, SegmentIndex segment) {
    partial_.NoteStored(key, segment);
  }

  // Why the store cannot be used; empty: it can.
  [[nodiscard]] const std::string& store_trouble() const { return watch_.trouble(); }
  [[nodiscard]] std::size_t partial_routes() const { return partial_.routes(); }
  [[nodiscard]] std::size_t lacking_segments() const { return partial_.segments(); }
  // Of these routes those that are served in part.
  [[nodiscard]] std::vector<exchange::LackingSegments> LackingOf(
      const std::vector<route::RouteInfo>& routes) const;
  [[nodiscard]] std::uint64_t dropped_strays() const { return dropped_strays_; }  // segments
  // "2 routes lack 5 segments here", or nothing.
  [[nodiscard]] std::string Degraded() const;

 private:
  [[nodiscard]] Result<void> SeeToRoutes(Time now);
  [[nodiscard]] Result<void> SeeToStrays(Time now);

  exchange::RouteKeeper& keeper_;
  StoreWatch watch_;
  catalog::PartialRoutes partial_;
  catalog::Strays strays_;
  std::uint64_t dropped_strays_ = 0;
  Time due_{};
  std::string told_;  // what went wrong last
};

}  // namespace trailcast::server
