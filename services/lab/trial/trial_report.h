#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "services/lab/trial/path_judge.h"
#include "services/lab/trial/scenario.h"
#include "services/refresh/refresh.h"

namespace trailcast::trial {

// Of a follower with a scanner.
struct ScanFigures {
  // Standing before what stood in its way, whichever of its senses had it stand.
  double waited_s = 0.0;
  double nearest_m = std::numeric_limits<double>::infinity();  // what it scanned, from its side
  bool touched = false;                                        // something, by its bumper
};

// Of a follower that is set down anywhere along the path.
struct FoundFigures {
  double at_m = 0.0;     // from the path's beginning, where it was set down
  double after_s = 0.0;  // it knew where it was, and set off
  double off_m = 0.0;    // along the path, from where it was
};

// One trial: who, under which conditions, and what truth says of it.
struct TrialRow {
  std::string scenario;
  std::string method;
  std::string scout_camera;
  std::string follower_camera;
  double push_m = 0.0;      // to the left, half way
  std::string flaw;         // of the follower; empty: none
  std::uint64_t seed = 0;   // `--trials 1 --seed <this>` repeats this trial alone
  int trial = 0;            // from 1
  bool same_robot = false;  // the robot that taught followed
  bool arrived = false;     // by itself, within 2 m, never more than 5 m off
  PathVerdict verdict;
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();  // of the taught path
  double found_share = 0.0;
  double bytes_per_m = 0.0;
  double ms_per_frame = 0.0;  // CPU time of the replay session; the one figure that varies by run
  std::string state;          // arrived, lost, stuck, strayed, misplaced (arrived elsewhere)
  double taught_m = 0.0;
  int segments = 0;
  int frames = 0;
  int hand_overs = 0;
  std::vector<double> lap_ends_m;     // how far from the taught end each lap ended
  std::optional<ScanFigures> scan;    // in no CSV
  bool set_down = false;              // somewhere, and told no place; in no CSV
  std::optional<FoundFigures> found;  // in no CSV; nothing: it never set off
  int visit = 0;                      // from 1; 0: there is but one; in no CSV
  // What it made of the route for the next visit; nothing: it left that as it was; in no CSV.
  std::optional<refresh::RefreshCounts> refreshed;
  std::string reason;  // why it ended, if it did not arrive
};

// Over all trials; a failed one counts with the distance at which it ended.
struct TrialSummary {
  int trials = 0;
  int arrived = 0;
  double accuracy_m = 0.0;       // RMS distance of the final positions to the taught end
  double repeatability_m = 0.0;  // RMS distance of the final positions to their mean
  double largest_final_error_m = 0.0;
  double mean_path_error_m = 0.0;
  double p90_path_error_m = 0.0;  // the largest of all trials'
  double max_path_error_m = 0.0;
  double found_share = 0.0;
  double segments = 0.0;
  double bytes_per_m = 0.0;
  double ms_per_frame = 0.0;
};

[[nodiscard]] TrialSummary Summarize(const std::vector<TrialRow>& rows);

// What sets a trial's row apart from others of its scenario, besides the seed: method, cameras,
// whether one robot did both, push and flaw; and the rows of each, in the order of their first
// ones.
[[nodiscard]] std::string CaseName(const TrialRow& row);
[[nodiscard]] std::vector<std::vector<TrialRow>> Cases(const std::vector<TrialRow>& rows);

// What the paper says of a scenario and method that it has; the default is measured against the
// later of the paper's two.
[[nodiscard]] std::optional<PaperFigures> PaperFiguresFor(const TrialRow& row);

// For people: one line a trial, then the summary with the paper's figures beside it where the
// scenario is one of the paper's.
[[nodiscard]] std::string TrialTable(const std::vector<TrialRow>& rows);

// In Markdown, of any number of scenarios: the paper's Table I with ours beside it, as far as there
// are rows of it, then every case with all its figures.
[[nodiscard]] std::string TrialMarkdown(const std::vector<TrialRow>& rows);

}  // namespace trailcast::trial
