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
  int every = 4;          // frames of the replayed recording: the others are not looked at
  int teach_every = 4;    // of the taught one: places are told no closer than this
  int good_inliers = 15;  // 14 were found between pictures of different places, too
  int jobs = 1;           // threads
  // Up to so many pairs of pictures, each is compared with each; beyond, those near the place last
  // held, and all over the route where that is lost.
  std::size_t most_pairs = 200'000;
};

// What is being done, and how much of it: 0..1. False ends it.
using AlignProgress = std::function<bool(const char* doing, double share)>;

struct Aligned {
  Reference reference;
  std::vector<std::string> news;  // what was found out of either's pictures; for people
};

// Where on one recording the frames of another were taken: SIFT features of both, held against the
// geometry of two views, and the most likely way through them. Takes minutes. Memory does not grow
// with the recordings but for a few bytes a comparison; features are in a temporary file. Errors:
// recordings that cannot be read, a full disk; kUnavailable when ended by `on_progress`.
[[nodiscard]] Result<Aligned> Align(const std::filesystem::path& teach,
                                    const std::filesystem::path& replay,
                                    const AlignOptions& options, const AlignProgress& on_progress);

}  // namespace trailcast::trial
