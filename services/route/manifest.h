#pragma once

#include <vector>

#include "services/route/route.h"

namespace trailcast::route {

// This is a scout's info of the route that it teaches, kept in step with the segments taught so
// far.
class RouteBuilder {
 public:
  // Expects an `info` that says who teaches what. Its state, counts, sums and digest are set here,
  // to those of a route without segments that is being taught.
  explicit RouteBuilder(RouteInfo info);

  // Encodes and hashes the next segment and counts it in. Its index must be the number of segments
  // so far, and the route must not be complete.
  [[nodiscard]] SegmentPiece Add(const Segment& segment);
  // Counts in the next segment as it was encoded before. `length_m` is the length in it.
  void Add(const SegmentPiece& piece, double length_m);
  // Ends the route. It is `cut_off` if its scout did not mean to end here.
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
