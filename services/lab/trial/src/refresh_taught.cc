#include "services/lab/trial/refresh_taught.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "services/route/digest.h"

namespace trailcast::trial {

Result<refresh::Refreshed> RefreshTaught(const refresh::Visit& visit, TaughtRoute& route) {
  std::vector<route::Segment> segments;
  segments.reserve(route.pieces.size());
  for (const route::SegmentPiece& piece : route.pieces) {
    auto segment = route::Open(piece);
    if (!segment) return tl::unexpected(segment.error());
    segments.push_back(std::move(*segment));
  }
  auto refreshed = refresh::Refresh(segments, visit);
  if (!refreshed) return refreshed;
  route.info.bytes = 0;
  for (std::size_t i = 0; i < route.pieces.size(); ++i) {
    route.pieces[i] = route::MakePiece(route.info.key, refreshed->segments[i]);
    route.info.bytes += route.pieces[i].bytes.size();
  }
  return refreshed;
}

}  // namespace trailcast::trial
