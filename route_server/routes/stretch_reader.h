#pragma once

#include <memory>
#include <optional>

#include "services/joints/route_views.h"
#include "services/store/route_store.h"

namespace trailcast::server {

// What a stored segment is. Errors are the store's; kCorrupt, too, for bytes that mean nothing.
[[nodiscard]] Result<route::Segment> ReadSegment(store::RouteStore& store,
                                                 const route::RouteKey& key, SegmentIndex index);

// A revision that a joint may lead to or from (followable.h); nothing for any other.
[[nodiscard]] Result<std::optional<route::RouteInfo>> FindJoinable(store::RouteStore& store,
                                                                   const route::RouteKey& key);

// The key views of a stretch of a revision, read bit by bit: where it begins follows from the
// segments before it.
class StretchReader {
 public:
  static constexpr std::uint32_t kMost = 2'000;  // segments: some 10 MB of views

  // Up to the last one that there is, and no more than so many.
  StretchReader(route::RouteInfo info, SegmentIndex first, SegmentIndex last);

  // Reads a segment. True: that was the last.
  [[nodiscard]] Result<bool> Step(store::RouteStore& store);

  [[nodiscard]] const route::RouteInfo& info() const { return info_; }
  // Once all is read; afterwards there are none.
  [[nodiscard]] std::shared_ptr<const joints::RouteViews> TakeViews() { return std::move(views_); }

 private:
  route::RouteInfo info_;
  std::uint32_t first_;
  std::uint32_t end_;  // one beyond the last
  std::uint32_t next_ = 0;
  double along_m_ = 0.0;
  std::shared_ptr<joints::RouteViews> views_;
};

}  // namespace trailcast::server
