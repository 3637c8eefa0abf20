#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "services/base/ids.h"
#include "services/route/route.h"

namespace trailcast::refresh {

// The result of looking for one of a segment's features while a follower drove along it.
enum class Sought : std::uint8_t {
  kUnjudged,  // it was not in view, or nothing near it was seen well enough to judge
  kFound,
  kMissed,  // other things were seen where it should have been, and it was not
};

// A follower's view of a place whose key view it hardly recognised, in the scout's pixels.
struct OfferedView {
  std::size_t beside = 0;  // position of the scout's view in the segment
  route::View features;
};

// A follower's findings in one segment, while it was sure of its place.
struct SegmentVisit {
  SegmentIndex index;
  std::vector<Sought> features;  // one for each of the segment's features, in order; empty if none
                                 // was judged
  // New features in the scout's terms, the most useful first: patches at the scale of the scout's
  // first image of the segment, knots in the scout's pixels.
  std::vector<route::Feature> offered;
  std::vector<Sought> views{};  // one for each of its key views, in order; empty if none was judged
  std::vector<OfferedView> offered_views{};
};

// One follower's drive along a whole route: its segments in rising order, without those in which it
// was not sure.
struct Visit {
  std::vector<SegmentVisit> segments;
};

}  // namespace trailcast::refresh
