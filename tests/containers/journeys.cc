// The demo's network of routes for scenarios/network.sh.
//   journeys plan FOLDER SEED    writes the way-points and says who is who, where, and with what
//   journeys judge FOLDER SEED   judges FOLDER/ROBOT-truth.csv and what each robot's 'send' said
//   last,
//                                a line each on the standard input; status 1: not all did well
#include <fmt/format.h>

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

Result<bool> Judge(const NetworkPlan& plan) {
  std::vector<std::string> said;
  for (std::string line; std::getline(std::cin, line);) said.push_back(line);
  const auto report = JudgeJourneys(plan, said);
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
