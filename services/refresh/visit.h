#pragma once

#include <cstddef>
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

// How the place of a key view looked to a follower that recognised too little of it, in the scout's
// pixels.
struct OfferedView {
  std::size_t beside = 0;  // position of the scout's in the segment
  route::View features;
};

// What a follower that was sure of its place met with in one segment.
struct SegmentVisit {
  SegmentIndex index;
  std::vector<Sought> features;  // one for each of the segment's, in their order; none: none judged
  // What it saw besides, told in the scout's terms: patches at the scale of the scout's first image
  // of the segment, knots in the scout's pixels. The most useful first.
  std::vector<route::Feature> offered;
  std::vector<Sought> views{};  // one for each of its key views, in their order; none: none judged
  std::vector<OfferedView> offered_views{};
};

// One follower's way along a whole route; segments in rising order, those it was unsure in left
// out.
struct Visit {
  std::vector<SegmentVisit> segments;
};

}  // namespace trailcast::refresh
