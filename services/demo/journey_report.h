#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/demo/demo_plan.h"
#include "services/plot/plan_plot.h"
#include "services/trial/path_judge.h"

namespace trailcast::demo {

// How a robot fared that was sent over the network of routes.
struct JourneyRow {
  DemoRobot robot;
  std::string from;       // where it stood
  bool arrived = false;   // by its own word and by the truth
  std::string said;       // what `send` said of it last
  double goal_m = 0.0;    // from where it was sent
  double beside_m = 0.0;  // at most, from the nearest taught path
  trial::TruePath path{};
};

struct JourneyReport {
  std::vector<trial::TruePath> taught;  // by the scouts, in the plan's order
  std::vector<JourneyRow> rows;         // in the order of the plan's journeys
  [[nodiscard]] bool AllArrived() const;
};

// Reads what the processes left. `goal_m`: along the first scout's path; `said`: of each journey.
// Errors: what a scout drove cannot be read, or does not reach the goal.
[[nodiscard]] Result<JourneyReport> JudgeJourneys(const NetworkPlan& plan, double goal_m,
                                                  const std::vector<std::string>& said);

[[nodiscard]] std::string JourneyTable(const JourneyReport& report);
// The taught paths first.
[[nodiscard]] std::vector<plot::PlottedPath> JourneyPaths(const NetworkPlan& plan,
                                                          const JourneyReport& report);

}  // namespace trailcast::demo
