#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"

namespace trailcast::trial {

// What is done to a recording before it is replayed, so that one recording tells more than one
// thing. First those that change the order of its frames, then those that change its pictures.
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
};

struct Change {
  ChangeKind kind = ChangeKind::kEvery;
  double value = 0.0;  // what it means is the kind's: see ChangeHelp

  bool operator==(const Change&) const = default;
};

// In the order in which they are done.
using Disturbance = std::vector<Change>;

// "every=3", "jpeg=30+gamma=0.6", "camera" (a value left out is the kind's own); "" or "none":
// nothing is done. The error says which there are.
[[nodiscard]] Result<Disturbance> ParseDisturbance(const std::string& text);

// One line for each kind, for people.
[[nodiscard]] std::string ChangeHelp();

// Of how many frames in a row one is shown.
[[nodiscard]] int StrideOf(const Disturbance& disturbance);
// Whether features are still to that side of where they were taught to which the reference has
// them.
[[nodiscard]] bool KeepsSides(const Disturbance& disturbance);
// Whether the driver still steers to where the pictures go.
[[nodiscard]] bool KeepsSteering(const Disturbance& disturbance);

}  // namespace trailcast::trial
