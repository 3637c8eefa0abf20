#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/route/route.h"
#include "services/route/view.h"

namespace trailcast::bench {

// This is a route that a scout taught.
struct Walk {
  std::string name;
  bool is_lap = false;  // ends where it begins
  std::vector<route::Segment> segments;
};

// This is a view by a robot that came along later.
struct HeldView {
  std::string set;
  std::uint32_t walk = 0;  // position in Corpus::walks
  SegmentIndex segment;    // where that was
  route::View view;
};

struct Corpus {
  std::vector<Walk> walks;
  std::vector<HeldView> held;  // of the walks
  std::vector<HeldView>
      strangers;  // of worlds in which nobody taught; walk and segment mean nothing
  std::vector<route::Segment> elsewhere;  // views of the taught worlds, away from the paths
};

// Teaches and sees everything anew, which takes minutes. `data` has recorded runs; absent ones are
// left out.
[[nodiscard]] Corpus MakeCorpus(const std::filesystem::path& data);

// Returns a segment that nobody taught, of features out of up to three of those. Some bits of each
// are flipped, and each group is in a place of its own. The same number gives the same segment.
[[nodiscard]] route::Segment Distractor(const std::vector<route::Segment>& elsewhere,
                                        std::uint32_t number);

}  // namespace trailcast::bench
