#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agent/session/replay_method.h"
#include "services/lab/trial/judge/recording_pair.h"
#include "services/lab/trial/judge/taught_recording.h"
#include "services/lab/trial/recording/judge.h"

namespace trailcast::trial {

// One replay of a recording on another one's route, and its verdict by the truth.
struct RecordingRow {
  std::string set;
  PairKind kind = PairKind::kRight;
  std::string teach;  // the recordings, by name
  std::string replay;
  std::string disturbance;
  std::string method;
  Verdict verdict;
  std::string state;  // the last: FOLLOWING, ARRIVED, LOST, ...
  // Why it ended before the recording did, because the session refused a frame or threw an
  // exception, or why no route could be taught.
  std::string error;
  std::vector<std::string> visits;  // outcomes of those that refreshed the route
  std::vector<std::string> news;    // what was found out about the replayed pictures, for people
  int segments = 0;
  double ms_per_frame = 0.0;  // CPU time of the replay session, the one figure that varies by run
};

struct RecordingOutcome {
  RecordingRow row;
  Replayed replayed;
  std::vector<std::string> states;              // by frame
  std::vector<std::optional<Alignment>> truth;  // by frame shown
};

// Returns the stem of its files' names: "REPLAY-on-TEACH-DISTURBED-METHOD".
[[nodiscard]] std::string FileStem(const RecordingRow& row);

struct RecordingOptions {
  agent::ReplayMethod method = agent::ReplayMethod::kDefault;
  bool anywhere = false;       // followers are not told that they are at the beginning
  std::uint64_t seed = 1;      // for disturbances
  std::filesystem::path logs;  // folder for one log a replay; may be empty
  JudgeOptions judging;        // its rate and width are the recording's
};

// Replays `pair` on the route taught with its first recording, frame by frame through an agent's
// session, and judges it. See Replayed for `own_turns_rad`. The same options give the same outcome,
// except for the CPU time. A failed replay is an outcome; an error is a file that cannot be read or
// written.
[[nodiscard]] Result<RecordingOutcome> RunRecordingTrial(
    const RecordingPair& pair, const TaughtRecording& taught,
    const std::vector<std::optional<double>>& own_turns_rad, const RecordingOptions& options,
    const std::function<void(double share)>& on_progress);

// Returns the turns that a recording, replayed on itself, asked for frame by frame, where it was
// followed.
[[nodiscard]] std::vector<std::optional<double>> OwnTurns(const RecordingOutcome& identity);

}  // namespace trailcast::trial
