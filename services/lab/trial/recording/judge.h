#pragma once

#include <optional>
#include <vector>

#include "services/lab/trial/recording/reference.h"

namespace trailcast::trial {

// A frame of a recording as a replay shows it.
struct Shown {
  int frame = 0;     // in the recording
  bool cut = false;  // the robot is not where the frame before would lead

  bool operator==(const Shown&) const = default;
};

// The robot's own account at one of them.
enum class Claim { kFollowing, kArrived, kUnsure, kLost };
struct Said {
  Claim claim = Claim::kUnsure;
  double teach_frame = 0.0;  // its estimate of its place on the taught recording
  double turn_rad = 0.0;     // positive to the right
};

// A replay of a recording: all frames to be shown, and the accounts as long as it ran.
struct Replayed {
  std::vector<Shown> shown;
  std::vector<Said> said;  // no longer than `shown`; shorter if an error ended the run
  int teach_frames = 0;    // frames with which the route was taught
  // Only every n-th frame of the recording is shown, and an alignment holds for the nearest.
  int stride = 1;
  // The turn that each frame of the taught recording asked for when it was itself replayed, which
  // is the route's own bend; empty where it is not known.
  std::vector<std::optional<double>> own_turns_rad;
};

struct JudgeOptions {
  double rate_hz = 30.0;         // of the shown frames
  int width_px = 0;              // of the recording; with 0, sides are not judged
  double right_within = 0.05;    // of the taught recording's length
  double side_above = 0.0125;    // share of the picture's width; anything smaller is no side
  double steering_above = 0.3;   // anything smaller is straight on
  int steering_leads_least = 2;  // by so many frames the driver's hand is ahead of the picture
  int steering_leads_most = 5;
  double found_within_s = 2.0;
};

// Counts, which can be summed over several replays.
struct Verdict {
  int frames = 0;     // shown or to be shown
  int following = 0;  // of these, FOLLOWING or ARRIVED
  int lost = 0;
  bool arrived = false;      // at some time
  int aligned = 0;           // frames with a good alignment:
  int right = 0;             // of these, following where they were taken
  int wrong = 0;             // following somewhere else
  int sided = 0;             // FOLLOWING where the truth has a side
  int side_right = 0;        // of these, asking for a turn to that side
  int corrected = 0;         // of those, where the route's own turn is known
  int correction_right = 0;  // of these, asking for more than that to that side
  int steered = 0;           // FOLLOWING where the driver steered, summed over the leads
  int steered_alike = 0;
  int offs = 0;                 // times when it was not right after it had been, or after a cut
  int found_in_time = 0;        // right again within JudgeOptions::found_within_s
  std::vector<double> found_s;  // how long it took, each time that it was right again

  void Add(const Verdict& other);
};

// Returns the good alignment of each shown frame, if there is one.
[[nodiscard]] std::vector<std::optional<Alignment>> AlignmentsOf(const Replayed& replayed,
                                                                 const Reference& reference);

// Without `reference` or `steering`, the counts that depend on them stay 0. A robot that is off at
// the recording's end, before the time to be found again is over, does not count as off.
[[nodiscard]] Verdict Judge(const Replayed& replayed, const Reference& reference,
                            const Steering& steering, const JudgeOptions& options);

}  // namespace trailcast::trial
