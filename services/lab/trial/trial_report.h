#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "services/lab/trial/matrix.h"
#include "services/lab/trial/path_judge.h"
#include "services/lab/trial/scenario.h"
#include "services/refresh/refresh.h"

namespace trailcast::trial {

// The figures of a follower with a scanner.
struct ScanFigures {
  // Time spent before obstacles, whichever sensor made it stop.
  double waited_s = 0.0;
  // the nearest thing that it scanned, from its side
  double nearest_m = std::numeric_limits<double>::infinity();
  bool touched = false;  // its bumper touched something
};

// The figures of a follower that is set down anywhere along the path.
struct FoundFigures {
  double at_m = 0.0;     // distance of that place from the path's beginning
  double after_s = 0.0;  // until it knew where it was, and set off
  double off_m = 0.0;    // along the path, from its true place
};

// One trial: the robots, the conditions, and the verdict by the truth.
struct TrialRow {
  std::string scenario;
  std::string method;
  std::string scout_camera;
  std::string follower_camera;
  double push_m = 0.0;      // to the left, half way
  std::string flaw;         // of the follower; may be empty
  std::uint64_t seed = 0;   // `--trials 1 --seed <this>` repeats this trial alone
  int trial = 0;            // from 1
  bool same_robot = false;  // the scout itself followed
  bool arrived = false;     // by itself, within 2 m, and never more than 5 m off
  PathVerdict verdict;
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();  // of the taught path
  double found_share = 0.0;
  double bytes_per_m = 0.0;
  double ms_per_frame = 0.0;  // CPU time of the replay session, the one figure that varies by run
  std::string state;          // arrived, lost, stuck, strayed, misplaced (arrived elsewhere)
  double taught_m = 0.0;
  int segments = 0;
  int frames = 0;
  int hand_overs = 0;
  std::vector<double> lap_ends_m;     // distance from the taught end, for each lap
  std::optional<ScanFigures> scan;    // not in the CSV
  bool set_down = false;              // anywhere, and told no place; not in the CSV
  std::optional<FoundFigures> found;  // nothing if it never set off; not in the CSV
  int visit = 0;                      // from 1; 0 if it is the only one; not in the CSV
  // Its changes to the route for the next visit, if it made any; not in the CSV.
  std::optional<refresh::RefreshCounts> refreshed;
  std::optional<MatrixCell> cell;  // not in the CSV
  std::string reason;              // why it ended, if it did not arrive
};

// The summary of all trials. A failed one counts with the distance at which it ended.
struct TrialSummary {
  int trials = 0;
  int arrived = 0;
  double accuracy_m = 0.0;       // RMS distance of the final positions to the taught end
  double repeatability_m = 0.0;  // RMS distance of the final positions to their mean
  double largest_final_error_m = 0.0;
  double mean_path_error_m = 0.0;
  double p90_path_error_m = 0.0;  // the largest of all trials
  double max_path_error_m = 0.0;
  double found_share = 0.0;
  double segments = 0.0;
  double bytes_per_m = 0.0;
  double ms_per_frame = 0.0;
};

[[nodiscard]] TrialSummary Summarize(const std::vector<TrialRow>& rows);

// CaseName returns what sets a trial's row apart from others of its scenario, except for the seed:
// method, cameras, whether one robot did both, push and flaw. Cases returns the rows of each case,
// in the order of their first ones.
[[nodiscard]] std::string CaseName(const TrialRow& row);
[[nodiscard]] std::vector<std::vector<TrialRow>> Cases(const std::vector<TrialRow>& rows);

// Returns the paper's figures for a scenario and method that it has. The default method is compared
// with the later of the paper's two.
[[nodiscard]] std::optional<PaperFigures> PaperFiguresFor(const TrialRow& row);

// Returns one line a trial for people, then the summary, with the paper's figures beside it if the
// scenario is one of the paper's.
[[nodiscard]] std::string TrialTable(const std::vector<TrialRow>& rows);

// Returns Markdown for any number of scenarios: the paper's table I with our figures beside it, as
// far as there are rows, and then every case with all its figures.
[[nodiscard]] std::string TrialMarkdown(const std::vector<TrialRow>& rows);

}  // namespace trailcast::trial
