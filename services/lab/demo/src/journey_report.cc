#include "services/lab/demo/journey_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "services/lab/demo/demo_report.h"
#include "services/lab/sim/core/path.h"

namespace trailcast::demo {
namespace {

constexpr double kThere_m = 0.5;
// A robot on another route does not come so near to the closed section.
constexpr double kTrespass_m = 0.3;
// No robot drives so far between two true positions.
constexpr double kCarried_m = 0.2;

Result<trial::TruePath> TaughtBy(const DemoRobot& scout) {
  return ReadTruth(scout.truth).transform(PathOf);
}

std::vector<trial::TruePath> LegsOf(const TruthFile& truth) {
  std::vector<trial::TruePath> legs;
  for (const Eigen::Vector2d& at_m : truth.positions_m) {
    if (legs.empty() || (at_m - legs.back().end_m()).norm() > kCarried_m) legs.emplace_back();
    legs.back().Add(at_m);
  }
  return legs;
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

bool Trespassed(const JourneyRow& row, const NetworkPlan& plan, const trial::TruePath& hall) {
  const auto is_on_it = [&](const Eigen::Vector2d& at_m) {
    return sim::Nearest(hall.points_m(), at_m, plan.closed_from_m, plan.closed_to_m).distance_m <
           kTrespass_m;
  };
  return std::any_of(row.legs.begin(), row.legs.end(), [&](const trial::TruePath& leg) {
    return std::any_of(leg.points_m().begin(), leg.points_m().end(), is_on_it);
  });
}

// Tells what else there is to say of a robot beside where it stood and stands.
std::string Tell(const JourneyRow& row) {
  const std::string& name = row.robot.name;
  std::string text;
  if (row.carried()) {
    const trial::TruePath& on = row.legs.back();
    const Eigen::Vector2d& to_m = on.points_m().front();
    text += fmt::format(
        "{} was carried off after {:.1f} m, to {:.1f},{:.1f}; it drove on for {:.1f} m and said: "
        "{}\n",
        name, row.legs.front().length_m(), to_m.x(), to_m.y(), on.length_m(), row.said);
  } else if (!row.arrived) {
    text += fmt::format("{} did not arrive: {}\n", name, row.said);
  }
  if (!row.carried() && !row.robot.carry.empty()) {
    text += fmt::format("{} was to be carried off, and did not come so far\n", name);
  }
  if (row.trespassed) text += fmt::format("{} drove on what was closed\n", name);
  return text;
}

const char* ResultOf(const JourneyRow& row) {
  if (!row.well()) return "FAILED";
  return row.arrived ? "arrived" : "gave up";
}

}  // namespace

bool JourneyReport::AllWell() const {
  return std::all_of(rows.begin(), rows.end(), [](const JourneyRow& row) { return row.well(); });
}

Result<JourneyReport> JudgeJourneys(const NetworkPlan& plan, const std::vector<JourneyEnd>& ends) {
  JourneyReport report;
  for (const DemoRobot& robot : plan.robots) {
    if (!robot.is_scout()) continue;
    auto taught = TaughtBy(robot);
    if (!taught) return tl::unexpected(taught.error());
    report.taught.push_back(std::move(*taught));
  }
  const trial::TruePath& to_goal = report.taught.front();
  if (to_goal.length_m() < plan.goal_m) {
    return Fail(ErrorCode::kNotFound, "{} was to teach {:.1f} m and more, and drove {:.1f}",
                plan.robots.front().name, plan.goal_m, to_goal.length_m());
  }
  const Eigen::Vector2d goal = sim::PointAlong(to_goal.points_m(), plan.goal_m);
  for (std::size_t i = 0; i < plan.journeys.size(); ++i) {
    const NetworkPlan::Journey& journey = plan.journeys[i];
    const auto last = i < ends.size() ? ends[i].last : std::nullopt;
    JourneyRow row{.robot = plan.robots[journey.robot],
                   .from = journey.from,
                   .said = i < ends.size() ? ends[i].said : "it was not sent"};
    const auto driven = ReadTruth(row.robot.truth);
    if (driven && !driven->positions_m.empty()) {
      row.legs = LegsOf(*driven);
      row.goal_m = (row.legs.back().end_m() - goal).norm();
      row.beside_m = Beside_m(row.legs.front(), report.taught);
      row.arrived = last && last->state == mission::State::kArrived && row.goal_m < kThere_m;
      row.gave_up = last && (last->state == mission::State::kFailed ||
                             last->waits_for == mission::WaitsFor::kWay);
      row.trespassed = Trespassed(row, plan, to_goal);
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
      return row.legs.empty() ? std::string("-") : fmt::format("{:.3f}", value);
    };
    text +=
        fmt::format("{:<9} {:<15} {:<10} {:<8} {:>16} {:>15}\n", row.robot.name, row.robot.camera,
                    row.from, ResultOf(row), metres(row.goal_m), metres(row.beside_m));
  }
  for (const JourneyRow& row : report.rows) text += Tell(row);
  return text;
}

std::vector<plot::PlottedPath> JourneyPaths(const NetworkPlan& plan, const JourneyReport& report) {
  std::vector<plot::PlottedPath> paths;
  for (std::size_t i = 0; i < report.taught.size(); ++i) {
    paths.push_back({fmt::format("{} ({}): taught '{}'", plan.robots[i].name, plan.robots[i].camera,
                                 plan.robots[i].route),
                     plot::PathColor(0), report.taught[i].points_m(), true});
  }
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    const JourneyRow& row = report.rows[i];
    const image::Color color = plot::PathColor(i + 1);
    const std::string label =
        fmt::format("{} ({}): from {}, {}{}, {:.2f} m from the goal", row.robot.name,
                    row.robot.camera, row.from, row.carried() ? "carried off, " : "",
                    row.arrived ? "arrived" : "did not arrive", row.goal_m);
    for (const trial::TruePath& leg : row.legs) {
      const bool last = &leg == &row.legs.back();
      paths.push_back({last ? label : "", color, leg.points_m(), false, last && !row.arrived});
    }
  }
  return paths;
}

}  // namespace trailcast::demo
