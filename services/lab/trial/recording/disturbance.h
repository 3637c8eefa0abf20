#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::trial {

// The changes to a recording before it is replayed, so that one recording tests several things.
// Changes of the frames' order come first, then changes of the pictures.
enum class ChangeKind {
  kEvery,
  kSlower,
  kReverse,
  kSkip,
  kJump,
  kFrom,
  kCamera,
  kGamma,
  kNoise,
  kJpeg,
  kSmear,
  kCrop,
  kBlur,
  kFlare,
};

struct Change {
  ChangeKind kind = ChangeKind::kEvery;
  double value = 0.0;  // its meaning depends on the kind; see ChangeHelp

  bool operator==(const Change&) const = default;
};

// Changes in the order in which they are made.
using Disturbance = std::vector<Change>;

// Parses "every=3", "jpeg=30+gamma=0.6" or "camera" (a missing value is the kind's own); "" or
// "none" stand for no change. The error lists the kinds.
[[nodiscard]] Result<Disturbance> ParseDisturbance(const std::string& text);

// Returns one line for each kind, for people.
[[nodiscard]] std::string ChangeHelp();

// Returns n if every n-th frame is shown.
[[nodiscard]] int StrideOf(const Disturbance& disturbance);
// Says whether features are still on the side of their taught place that the reference has.
[[nodiscard]] bool KeepsSides(const Disturbance& disturbance);
// Says whether the driver's steering still matches the pictures.
[[nodiscard]] bool KeepsSteering(const Disturbance& disturbance);

}  // namespace trailcast::trial
