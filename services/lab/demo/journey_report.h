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

// A journey ended like this by its robot's own word.
struct JourneyEnd {
  std::string said;                     // what `send` said of it last, for people
  std::optional<mission::Report> last;  // none was heard: it was not sent
};

// How a robot fared that was sent over the network of routes.
struct JourneyRow {
  DemoRobot robot;
  std::string from;         // where it stood
  std::string said;         // what `send` said of it last
  bool arrived = false;     // by its own word and by the truth
  bool gave_up = false;     // or waits where no way leads on; by its own word, which says why
  double goal_m = 0.0;      // from where it was sent
  double beside_m = 0.0;    // at most, from the nearest taught path, before it was carried off
  bool trespassed = false;  // on what is closed
  // What it drove: two of them if it was carried off in between.
  std::vector<trial::TruePath> legs{};

  [[nodiscard]] bool carried() const { return legs.size() > 1; }
  // It did what it was to do: who was carried off may give up, too.
  [[nodiscard]] bool well() const {
    return !trespassed && carried() == !robot.carry.empty() && (arrived || (carried() && gave_up));
  }
};

struct JourneyReport {
  std::vector<trial::TruePath> taught;  // by the scouts, in the plan's order
  std::vector<JourneyRow> rows;         // in the order of the plan's journeys
  [[nodiscard]] bool AllWell() const;
};

// Reads what the processes left. `ends`: of each journey. Errors: what a scout drove cannot be
// read, or does not reach the goal.
[[nodiscard]] Result<JourneyReport> JudgeJourneys(const NetworkPlan& plan,
                                                  const std::vector<JourneyEnd>& ends);

[[nodiscard]] std::string JourneyTable(const JourneyReport& report);
// The taught paths first.
[[nodiscard]] std::vector<plot::PlottedPath> JourneyPaths(const NetworkPlan& plan,
                                                          const JourneyReport& report);

}  // namespace trailcast::demo
