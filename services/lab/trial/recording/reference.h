#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "services/base/result.h"

namespace trailcast::trial {

// Where on the taught recording a frame of the replayed one was taken, as found offline.
struct Alignment {
  int replay_frame = 0;  // both counted from 0, in the order in which recordings are read
  int teach_frame = 0;
  int inliers = 0;  // features that agree on one camera motion between the two pictures
  // The median of how much further right they are in the replay's picture, in pixels of the
  // recording. A positive value asks for a turn to the right.
  double median_du_px = 0.0;
  bool good = false;  // there are enough of them; others tell nothing
};

// In rising replay frames, of which some may be missing.
using Reference = std::vector<Alignment>;

// Reads CSV `replay_frame,teach_frame,inliers,median_du_px,good`. Errors name file, line and what
// was expected there.
[[nodiscard]] Result<Reference> ReadReference(const std::filesystem::path& file);
[[nodiscard]] Result<void> WriteReference(const Reference& reference,
                                          const std::filesystem::path& file);

// Returns the reference of a recording on itself.
[[nodiscard]] Reference IdentityReference(int frames);

// The steering of a recording's driver, by its frames; above 0 is to the right.
using Steering = std::map<int, double>;

// Reads CSV `frame,steering`; further columns are ignored.
[[nodiscard]] Result<Steering> ReadSteering(const std::filesystem::path& file);

}  // namespace trailcast::trial
