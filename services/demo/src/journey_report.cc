#include "services/demo/journey_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "services/demo/demo_report.h"
#include "services/sim/core/path.h"

namespace trailcast::demo {
namespace {

constexpr double kThere_m = 0.5;

Result<trial::TruePath> DrivenBy(const DemoRobot& robot) {
  return ReadTruth(robot.truth).transform(PathOf);
}

double Beside_m(const trial::TruePath& driven, const std::vector<trial::TruePath>& taught) {
  double most_m = 0.0;
  for (const Eigen::Vector2d& point_m : driven.points_m()) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const trial::TruePath& path : taught) {
      least_m = std::min(least_m, path.DistanceTo(point_m));
    }
    most_m = std::max(most_m, least_m);
  }
  return most_m;
}

}  // namespace

bool JourneyReport::AllArrived() const {
  return std::all_of(rows.begin(), rows.end(), [](const JourneyRow& row) { return row.arrived; });
}

Result<JourneyReport> JudgeJourneys(const NetworkPlan& plan, double goal_m,
                                    const std::vector<std::string>& said) {
  JourneyReport report;
  for (const DemoRobot& robot : plan.robots) {
    if (!robot.is_scout()) continue;
    auto taught = DrivenBy(robot);
    if (!taught) return tl::unexpected(taught.error());
    report.taught.push_back(std::move(*taught));
  }
  const trial::TruePath& to_goal = report.taught.front();
  if (to_goal.length_m() < goal_m) {
    return Fail(ErrorCode::kNotFound, "{} was to teach {:.1f} m and more, and drove {:.1f}",
                plan.robots.front().name, goal_m, to_goal.length_m());
  }
  const Eigen::Vector2d goal = sim::PointAlong(to_goal.points_m(), goal_m);
  for (std::size_t i = 0; i < plan.journeys.size(); ++i) {
    const NetworkPlan::Journey& journey = plan.journeys[i];
    JourneyRow row{.robot = plan.robots[journey.robot],
                   .from = journey.from,
                   .said = i < said.size() ? said[i] : "it was not sent"};
    const auto driven = DrivenBy(row.robot);
    if (driven && !driven->empty()) {
      row.path = *driven;
      row.goal_m = (row.path.end_m() - goal).norm();
      row.beside_m = Beside_m(row.path, report.taught);
      row.arrived = row.said == row.robot.name + ": arrived" && row.goal_m < kThere_m;
    }
    report.rows.push_back(std::move(row));
  }
  return report;
}

std::string JourneyTable(const JourneyReport& report) {
  std::string text = fmt::format("{:<9} {:<15} {:<10} {:<8} {:>16} {:>15}\n", "robot", "camera",
                                 "stood at", "result", "m from the goal", "m beside paths");
  for (const JourneyRow& row : report.rows) {
    const auto metres = [&](double value) {
      return row.path.empty() ? std::string("-") : fmt::format("{:.3f}", value);
    };
    text += fmt::format("{:<9} {:<15} {:<10} {:<8} {:>16} {:>15}\n", row.robot.name,
                        row.robot.camera, row.from, row.arrived ? "arrived" : "FAILED",
                        metres(row.goal_m), metres(row.beside_m));
  }
  for (const JourneyRow& row : report.rows) {
    if (!row.arrived) text += fmt::format("{} did not arrive: {}\n", row.robot.name, row.said);
  }
  return text;
}

std::vector<plot::PlottedPath> JourneyPaths(const NetworkPlan& plan, const JourneyReport& report) {
  std::vector<plot::PlottedPath> paths;
  for (std::size_t i = 0; i < report.taught.size(); ++i) {
    paths.push_back({fmt::format("{} ({}): taught '{}'", plan.robots[i].name, plan.robots[i].camera,
                                 plan.robots[i].route),
                     plot::PathColor(0), report.taught[i].points_m(), true});
  }
  for (const JourneyRow& row : report.rows) {
    paths.push_back({fmt::format("{} ({}): from {}, {}, {:.2f} m from the goal", row.robot.name,
                                 row.robot.camera, row.from,
                                 row.arrived ? "arrived" : "did not arrive", row.goal_m),
                     plot::PathColor(paths.size() - report.taught.size() + 1), row.path.points_m(),
                     false, !row.arrived});
  }
  return paths;
}

}  // namespace trailcast::demo
