#pragma once

#include <vector>

#include "services/route/route.h"

namespace trailcast::route {

// What a scout knows of the route it teaches, kept in step with the segments taught so far.
class RouteBuilder {
 public:
  // `info` says who teaches what; its state, counts, sums and digest are set here, to a route
  // without segments that is being taught.
  explicit RouteBuilder(RouteInfo info);

  // Encodes and hashes the next segment and counts it in. Its index must be the number of segments
  // so far, and the route not complete.
  [[nodiscard]] SegmentPiece Add(const Segment& segment);
  // Counts in the next segment as it was encoded before; `length_m` is what it says.
  void Add(const SegmentPiece& piece, double length_m);
  // No more segments will come; `cut_off`: though whoever teaches did not mean to end here.
  void Complete(bool cut_off = false) {
    info_.state = RouteState::kComplete;
    info_.cut_off = cut_off;
  }

  [[nodiscard]] const RouteInfo& info() const { return info_; }

 private:
  RouteInfo info_;
  std::vector<Digest> digests_;
};

}  // namespace trailcast::route
