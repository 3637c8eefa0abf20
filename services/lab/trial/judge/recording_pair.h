#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "agent/device/recorded_device.h"
#include "services/base/result.h"
#include "services/lab/trial/recording/disturbance.h"

namespace trailcast::trial {

// The expected result of a replay on another recording's route.
enum class PairKind {
  kIdentity,  // the taught recording itself: followed in every frame
  kRight,     // the same way at another time: followed, at the right place
  kWrong,     // another place: never followed
};
[[nodiscard]] const char* ToString(PairKind kind);

// A route taught with one recording, and another recording that is replayed on it.
struct RecordingPair {
  PairKind kind = PairKind::kRight;
  std::string set;  // for tables; pairs with the same word belong together ("tuned", "held out")
  std::string teach_name;  // for people
  std::string replay_name;
  agent::RecordedRun teach;
  agent::RecordedRun replay;
  // Followers in between, one after the other, each of which refreshes the route if it arrives.
  std::vector<agent::RecordedRun> visits;
  std::string visits_disturbance;   // for all of these; see ParseDisturbance
  std::filesystem::path reference;  // of the replay on the teaching; may be empty
  std::filesystem::path steering;   // of the replay's driver; may be empty
  std::string disturbance;          // of the replay; see ParseDisturbance
  std::string odometry_noise;       // of the replay's odometry; see ParseOdometryNoise
};

// Reads CSV with a header. `teach` and `replay` are required; `kind`, `set`, `truth`, `steering`,
// `disturb`, `teach_odometry`, `replay_odometry`, `odometry_noise`, `rate`, `visits` (with +
// between) and `disturb_visits` are optional, in any order. Relative files are below `root`. Errors
// name file, line and what was expected there.
[[nodiscard]] Result<std::vector<RecordingPair>> ReadPairs(const std::filesystem::path& file,
                                                           const std::filesystem::path& root);

}  // namespace trailcast::trial
