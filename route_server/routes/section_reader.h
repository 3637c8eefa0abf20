#pragma once

#include <memory>
#include <optional>

#include "services/junctions/route_views.h"
#include "services/store/route_store.h"

namespace trailcast::server {

// Reads and decodes a stored segment. Errors are the store's, and kCorrupt for bytes that cannot be
// decoded.
[[nodiscard]] Result<route::Segment> ReadSegment(store::RouteStore& store,
                                                 const route::RouteKey& key, SegmentIndex index);

// Returns a revision on which a junction may be (followable.h), or nothing for any other.
[[nodiscard]] Result<std::optional<route::RouteInfo>> FindJoinable(store::RouteStore& store,
                                                                   const route::RouteKey& key);

// Reads the key views of a section of a revision bit by bit. The segments before it tell where it
// begins.
class SectionReader {
 public:
  static constexpr std::uint32_t kMost = 2'000;  // segments, with some 10 MB of views

  // Ends at the last existing segment, and after kMost of them.
  SectionReader(route::RouteInfo info, SegmentIndex first, SegmentIndex last);

  // Reads a segment; returns true if it was the last.
  [[nodiscard]] Result<bool> Step(store::RouteStore& store);

  [[nodiscard]] const route::RouteInfo& info() const { return info_; }
  // Returns the views once everything is read, and gives them away.
  [[nodiscard]] std::shared_ptr<const junctions::RouteViews> TakeViews() {
    return std::move(views_);
  }

 private:
  route::RouteInfo info_;
  std::uint32_t first_;
  std::uint32_t end_;  // one beyond the last
  std::uint32_t next_ = 0;
  double along_m_ = 0.0;
  std::shared_ptr<junctions::RouteViews> views_;
};

}  // namespace trailcast::server
