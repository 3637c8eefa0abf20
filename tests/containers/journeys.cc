// The demo's network of routes for scenarios/network.sh.
//   journeys plan FOLDER SEED    writes the way-points and says who is who, where, and with what
//   journeys judge FOLDER SEED   judges FOLDER/ROBOT-truth.csv and what each robot's 'send' said
//   last,
//                                a line each on the standard input; status 1: not all did well
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "services/base/number.h"
#include "services/lab/demo/journey_report.h"

namespace trailcast::demo {
namespace {

void Tell(const NetworkPlan& plan) {
  std::size_t journey = 0;
  for (const DemoRobot& robot : plan.robots) {
    const std::string from = robot.is_scout() ? "-" : plan.journeys[journey++].from;
    fmt::print("{} {} {} {} {} {} {} {}\n", robot.is_scout() ? "scout" : "robot", robot.name,
               robot.route, robot.camera_word, robot.seed, robot.path.string(), from,
               robot.carry.empty() ? "-" : robot.carry);
  }
  fmt::print("place {}\nclosed {}..{}\n", plan.goal_m, plan.closed_from_m, plan.closed_to_m);
}

// "robot-1: arrived", "robot-1: fetching: waits for a way: ..": as a person reads it.
JourneyEnd EndOf(const std::string& said) {
  JourneyEnd end{.said = said, .last = std::nullopt};
  const std::string told = said.substr(std::min(said.size(), said.find(' ') + 1));
  const bool asks = told.starts_with("fetching: waits for a way: ");
  for (std::uint8_t i = 0; i < mission::kStates; ++i) {
    const auto state = static_cast<mission::State>(i);
    if (!told.starts_with(mission::ToString(state))) continue;
    end.last = mission::Report{
        .state = state, .waits_for = asks ? mission::WaitsFor::kWay : mission::WaitsFor::kNothing};
  }
  return end;
}

Result<bool> Judge(const NetworkPlan& plan) {
  std::vector<JourneyEnd> ends;
  for (std::string line; std::getline(std::cin, line);) ends.push_back(EndOf(line));
  const auto report = JudgeJourneys(plan, ends);
  if (!report) return tl::unexpected(report.error());
  fmt::print("{}", JourneyTable(*report));
  return report->AllWell();
}

Result<bool> Run(const std::vector<std::string>& words) {
  const auto seed = words.size() == 3 ? ParseNumber<std::uint64_t>(words[2]) : std::nullopt;
  if (!seed || (words[0] != "plan" && words[0] != "judge")) {
    return Fail(ErrorCode::kInvalidArgument, "expected plan|judge FOLDER SEED");
  }
  const auto plan = PlanNetwork(words[1], *seed);
  if (!plan) return tl::unexpected(plan.error());
  if (words[0] == "judge") return Judge(*plan);
  Tell(*plan);
  return true;
}

}  // namespace
}  // namespace trailcast::demo

int main(int argc, char** argv) {
  const auto well = trailcast::demo::Run({argv + 1, argv + argc});
  if (!well) std::cerr << "journeys: " << well.error().message << '\n';
  return well && *well ? 0 : 1;
}
