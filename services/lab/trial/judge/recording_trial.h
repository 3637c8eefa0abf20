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

// One replay of a recording on another one's route, and what the truth says of it.
struct RecordingRow {
  std::string set;
  PairKind kind = PairKind::kRight;
  std::string teach;  // the recordings, by name
  std::string replay;
  std::string disturbance;
  std::string method;
  Verdict verdict;
  std::string state;  // the last: FOLLOWING, ARRIVED, LOST, ...
  // What ended it before the recording did: the session refused a frame, or threw. Also why no
  // route could be taught.
  std::string error;
  std::vector<std::string> visits;  // what has come of those who refreshed the route
  std::vector<std::string> news;    // what was found out of the replayed pictures; for people
  int segments = 0;
  double ms_per_frame = 0.0;  // CPU time of the replay session; the one figure that varies by run
};

struct RecordingOutcome {
  RecordingRow row;
  Replayed replayed;
  std::vector<std::string> states;              // as told, by frame
  std::vector<std::optional<Alignment>> truth;  // by frame shown
};

// What its files are called: "REPLAY-on-TEACH-DISTURBED-METHOD".
[[nodiscard]] std::string FileStem(const RecordingRow& row);

struct RecordingOptions {
  agent::ReplayMethod method = agent::ReplayMethod::kDefault;
  bool anywhere = false;       // followers are not told that they are at the beginning
  std::uint64_t seed = 1;      // of what is drawn to disturb
  std::filesystem::path logs;  // folder for one log a replay; empty: none
  JudgeOptions judging;        // its rate and width are the recording's
};

// Replays `pair` on what was taught with its first recording, frame by frame through the session
// that an agent has, and judges it. `own_turns_rad` as in Replayed. The same options give
// the same outcome, but for the CPU time. A replay that fails is an outcome; an error is a file
// that cannot be read or written.
[[nodiscard]] Result<RecordingOutcome> RunRecordingTrial(
    const RecordingPair& pair, const TaughtRecording& taught,
    const std::vector<std::optional<double>>& own_turns_rad, const RecordingOptions& options,
    const std::function<void(double share)>& on_progress);

// What a recording, replayed on itself, asked for frame by frame, as far as it was followed.
[[nodiscard]] std::vector<std::optional<double>> OwnTurns(const RecordingOutcome& identity);

}  // namespace trailcast::trial
