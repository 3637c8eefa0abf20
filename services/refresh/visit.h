#pragma once

#include <cstdint>
#include <vector>

#include "services/base/ids.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// What became of one of a segment's features while a follower drove along it.
enum class Sought : std::uint8_t {
  kUnjudged,  // it was not in view, or nothing near it was seen well enough to tell
  kFound,
  kMissed,  // where it should have been, other things were seen and it was not
};

// What a follower that was sure of its place met with in one segment.
struct SegmentVisit {
  SegmentIndex index;
  std::vector<Sought> features;  // one for each of the segment's, in their order
  // What it saw besides, told in the scout's terms: patches at the scale of the scout's first image
  // of the segment, knots in the scout's pixels. The most useful first.
  std::vector<route::Feature> offered;
};

// One follower's way along a whole route; segments in rising order, those it was unsure in left
// out.
struct Visit {
  std::vector<SegmentVisit> segments;
};

}  // namespace trailcast::refresh
