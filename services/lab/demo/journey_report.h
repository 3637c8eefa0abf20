#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/demo/demo_plan.h"
#include "services/lab/trial/path_judge.h"
#include "services/mission/mission.h"
#include "services/plot/plan_plot.h"

namespace trailcast::demo {

// The end of a journey by its robot's own report.
struct JourneyEnd {
  std::string said;                     // the last line of `send`, for people
  std::optional<mission::Report> last;  // nothing if none was heard, because it was not sent
};

// The result of a robot that was sent over the network.
struct JourneyRow {
  DemoRobot robot;
  std::string from;         // where it stood
  std::string said;         // the last line of `send`
  bool arrived = false;     // by its own report and by the truth
  bool gave_up = false;     // or waits where no path leads on; its report says why
  double goal_m = 0.0;      // distance from its destination
  double beside_m = 0.0;    // largest distance from the nearest taught path, before it was carried
                            // off
  bool trespassed = false;  // in the closed section
  // The paths that it drove; there are two if it was carried off in between.
  std::vector<trial::TruePath> legs{};

  [[nodiscard]] bool carried() const { return legs.size() > 1; }
  // Says whether it did its task. A robot that was carried off may also give up.
  [[nodiscard]] bool well() const {
    return !trespassed && carried() == !robot.carry.empty() && (arrived || (carried() && gave_up));
  }
};

struct JourneyReport {
  std::vector<trial::TruePath> taught;  // by the scouts, in the plan's order
  std::vector<JourneyRow> rows;         // in the order of the plan's journeys
  [[nodiscard]] bool AllWell() const;
};

// Reads the files that the processes left. `ends` has one for each journey. Error: a scout's path
// cannot be read, or does not reach the destination.
[[nodiscard]] Result<JourneyReport> JudgeJourneys(const NetworkPlan& plan,
                                                  const std::vector<JourneyEnd>& ends);

[[nodiscard]] std::string JourneyTable(const JourneyReport& report);
// Returns the paths, the taught ones first.
[[nodiscard]] std::vector<plot::PlottedPath> JourneyPaths(const NetworkPlan& plan,
                                                          const JourneyReport& report);

}  // namespace trailcast::demo
