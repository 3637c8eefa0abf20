#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/demo/demo_fleet.h"
#include "services/lab/trial/path_judge.h"
#include "services/plot/plan_plot.h"

namespace trailcast::demo {

// A simulated robot's true positions as its process wrote them: `t_s,x_m,y_m,heading_rad`.
struct TruthFile {
  std::vector<Eigen::Vector2d> positions_m;
  double duration_s = 0.0;
};
[[nodiscard]] Result<TruthFile> ReadTruth(const std::filesystem::path& file);
[[nodiscard]] trial::TruePath PathOf(const TruthFile& truth);

// An agent's report: key=value lines.
[[nodiscard]] Result<std::map<std::string, std::string>> ReadReport(
    const std::filesystem::path& file);

// The result of one robot of the demo.
struct DemoRow {
  DemoRobot robot;
  bool arrived = false;        // by its own report and by the truth; a scout has taught and
                               // delivered its route
  std::string why_not;         // one line
  trial::PathVerdict verdict;  // for followers
  std::string found_share;
  std::string segments;
  std::string bytes_per_m;
  double duration_s = 0.0;  // of its drive, by its own clock
  trial::TruePath path;
};

// Reads the files that the processes left. `ended` tells how each of them ended, in the order of
// `robots`, of which the scout is the first. A robot whose files are missing has not arrived, and
// its row says so.
[[nodiscard]] std::vector<DemoRow> JudgeDemo(const std::vector<DemoRobot>& robots,
                                             const std::vector<std::optional<ExitStatus>>& ended);

[[nodiscard]] std::string DemoTable(const std::vector<DemoRow>& rows);
// Returns the paths, the taught one first.
[[nodiscard]] std::vector<plot::PlottedPath> DemoPaths(const std::vector<DemoRow>& rows);

}  // namespace trailcast::demo
