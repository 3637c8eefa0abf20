#pragma once

#include <filesystem>
#include <vector>

#include "services/route/digest.h"
#include "services/route/route.h"
#include "services/store/route_store.h"
#include "tests/bench/must.h"

namespace trailcast::bench {

struct Taught {
  route::RouteInfo info;
  std::vector<route::SegmentPiece> pieces;

  [[nodiscard]] std::vector<route::Segment> Segments() const {
    std::vector<route::Segment> segments;
    for (const route::SegmentPiece& piece : pieces) segments.push_back(Must(route::Open(piece)));
    return segments;
  }
};

// Returns the complete routes of a store.
inline std::vector<Taught> TaughtIn(const std::filesystem::path& file) {
  std::vector<Taught> taught;
  const auto store = Must(store::OpenSqliteStore(file));
  for (const route::RouteInfo& info : Must(store->ListRoutes())) {
    if (info.state != route::RouteState::kComplete) continue;
    Taught& route = taught.emplace_back(Taught{info, {}});
    for (std::uint32_t i = 0; i < info.segment_count; ++i) {
      route.pieces.push_back(Must(store->ReadSegment(info.key, SegmentIndex(i))));
    }
  }
  return taught;
}

// Returns a segment for each of their views, of which distractors (view_corpus.h) are made.
inline std::vector<route::Segment> ViewsApart(const std::vector<Taught>& routes) {
  std::vector<route::Segment> apart;
  for (const Taught& route : routes) {
    for (const route::Segment& segment : route.Segments()) {
      for (const route::KeyView& view : segment.key_views) {
        route::Segment one;
        one.has_odometry = true;
        one.length_m = 1.0;
        one.duration_s = 2.0;
        one.key_views.push_back({0.0, view.features});
        apart.push_back(std::move(one));
      }
    }
  }
  return apart;
}

}  // namespace trailcast::bench
