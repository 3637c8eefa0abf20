#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "agent/device/recorded_device.h"
#include "services/base/result.h"
#include "services/lab/trial/recording/disturbance.h"

namespace trailcast::trial {

// What a replay of a recording on another one's route ought to come to.
enum class PairKind {
  kIdentity,  // what was taught is shown again: followed in every frame
  kRight,     // the same way, another time: followed, at the right place
  kWrong,     // another place: never followed
};
[[nodiscard]] const char* ToString(PairKind kind);

// A route is taught with one recording, another one is replayed on it.
struct RecordingPair {
  PairKind kind = PairKind::kRight;
  std::string set;  // for tables: pairs with the same word belong together ("tuned", "held out")
  std::string teach_name;  // for people
  std::string replay_name;
  agent::RecordedRun teach;
  agent::RecordedRun replay;
  // Followers in between, one after the other, each of which refreshes the route if it arrives.
  std::vector<agent::RecordedRun> visits;
  std::string visits_disturbance;   // of all of these, as ParseDisturbance takes it
  std::filesystem::path reference;  // of the replay on the teaching; empty: none
  std::filesystem::path steering;   // of the replay's driver; empty: none
  std::string disturbance;          // of the replay, as ParseDisturbance takes it
  std::string odometry_noise;       // of the replay's odometry, as ParseOdometryNoise takes it
};

// CSV with a header; `teach` and `replay` are needed, `kind`, `set`, `truth`, `steering`,
// `disturb`, `teach_odometry`, `replay_odometry`, `odometry_noise`, `rate`, `visits` (with +
// between) and `disturb_visits` may be given, in any order. Files are below `root` unless they say
// otherwise. Errors name file, line and what was expected there.
[[nodiscard]] Result<std::vector<RecordingPair>> ReadPairs(const std::filesystem::path& file,
                                                           const std::filesystem::path& root);

}  // namespace trailcast::trial
