#pragma once

#include <optional>
#include <vector>

#include "services/lab/trial/recording/reference.h"

namespace trailcast::trial {

// A frame of a recording as a replay of it gets to see it.
struct Shown {
  int frame = 0;     // of the recording
  bool cut = false;  // the robot is elsewhere than the frame before would lead to

  bool operator==(const Shown&) const = default;
};

// What the robot said of itself at one of them.
enum class Claim { kFollowing, kArrived, kUnsure, kLost };
struct Said {
  Claim claim = Claim::kUnsure;
  double teach_frame = 0.0;  // where on the taught recording it took itself to be
  double turn_rad = 0.0;     // positive to the right
};

// A replay of a recording: all that it was to see, and what it said as long as it ran.
struct Replayed {
  std::vector<Shown> shown;
  std::vector<Said> said;  // no longer than `shown`; shorter where an error ended the run
  int teach_frames = 0;    // that the route was taught with
  // Only every so many of the recording's frames are shown: an alignment holds for the nearest.
  int stride = 1;
  // What each frame of the taught recording asked for when it was itself replayed: the route's own
  // bends. Empty, or nothing: not known.
  std::vector<std::optional<double>> own_turns_rad;
};

struct JudgeOptions {
  double rate_hz = 30.0;         // of the frames shown
  int width_px = 0;              // of the recording; 0: sides are not judged
  double right_within = 0.05;    // of the taught recording's length
  double side_above = 0.0125;    // of the picture's width: less is no side
  double steering_above = 0.3;   // less is straight on
  int steering_leads_least = 2;  // frames by which the driver's hand is ahead of the picture
  int steering_leads_most = 5;
  double found_within_s = 2.0;
};

// Counts, so that those of several replays can be added up.
struct Verdict {
  int frames = 0;     // shown, or to be shown
  int following = 0;  // FOLLOWING or ARRIVED in them
  int lost = 0;
  bool arrived = false;      // it said so at some time
  int aligned = 0;           // frames with a good alignment:
  int right = 0;             // following in them, at the place where they were taken
  int wrong = 0;             // following elsewhere
  int sided = 0;             // FOLLOWING where the truth has a side
  int side_right = 0;        // asking for a turn to that side
  int corrected = 0;         // of those, where it is known what the route itself asks for there
  int correction_right = 0;  // asking for more than that to that side
  int steered = 0;           // FOLLOWING where the driver steered, summed over the leads
  int steered_alike = 0;
  int offs = 0;                 // times that it was not right after it had been, or after a cut
  int found_in_time = 0;        // right again within JudgeOptions::found_within_s
  std::vector<double> found_s;  // how long it took, of all that were right again

  void Add(const Verdict& other);
};

// The good alignment of each frame shown, where there is one.
[[nodiscard]] std::vector<std::optional<Alignment>> AlignmentsOf(const Replayed& replayed,
                                                                 const Reference& reference);

// `reference` and `steering` may be empty: then what they decide is not counted. Whoever is off
// where the recording ends, before the time to be found again is over, is not counted as off.
[[nodiscard]] Verdict Judge(const Replayed& replayed, const Reference& reference,
                            const Steering& steering, const JudgeOptions& options);

}  // namespace trailcast::trial
