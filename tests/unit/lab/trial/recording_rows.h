#pragma once

#include <string>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::test {

// Returns a replay of 100 frames that followed all along, at the right place.
inline trial::RecordingRow Judged(const std::string& replay,
                                  const std::string& disturbance = "none",
                                  trial::PairKind kind = trial::PairKind::kRight) {
  trial::RecordingRow row;
  row.set = "tuned";
  row.kind = kind;
  row.teach = "hall/teach";
  row.replay = replay;
  row.disturbance = disturbance;
  row.method = "default";
  row.state = "ARRIVED";
  row.segments = 7;
  row.verdict.frames = row.verdict.following = 100;
  row.verdict.arrived = true;
  row.verdict.aligned = row.verdict.right = 50;
  return row;
}

}  // namespace trailcast::test
