#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/recording/reference.h"

namespace trailcast::trial {

struct AlignOptions {
  int every = 4;          // step between the replayed recording's frames; others are skipped
  int teach_every = 4;    // likewise for the taught one; places are not told more precisely
  int good_inliers = 15;  // pictures of different places had up to 14
  int jobs = 1;           // threads
  // Up to so many pairs, all pictures are compared with each other. With more, they are compared
  // near the last place held, and all over the route when that is lost.
  std::size_t most_pairs = 200'000;
};

// Called with the present activity and its progress, 0..1; false ends the alignment.
using AlignProgress = std::function<bool(const char* doing, double share)>;

struct Aligned {
  Reference reference;
  std::vector<std::string> news;  // what was found out about the pictures of both, for people
};

// Finds where on one recording the frames of another were taken, by SIFT features of both, checked
// against the geometry of two views, and the most likely path through the matches. It takes
// minutes. Memory grows only by a few bytes for each comparison, because features are in a
// temporary file. Errors: recordings that cannot be read, a full disk; kUnavailable if
// `on_progress` ended it.
[[nodiscard]] Result<Aligned> Align(const std::filesystem::path& teach,
                                    const std::filesystem::path& replay,
                                    const AlignOptions& options, const AlignProgress& on_progress);

}  // namespace trailcast::trial
