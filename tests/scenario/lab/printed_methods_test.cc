#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "services/lab/trial/trial_batch.h"

namespace trailcast::trial {
namespace {

// Chen & Birchfield's method as they measured it, one robot teaching and following, on the first
// metres of their outdoor grounds. The bounds are two to three times what was measured, and within
// the paper's own figures.
struct Ground {
  const char* scenario;
  double length_m;
  double final_m, max_m;

  friend std::ostream& operator<<(std::ostream& out, const Ground& ground) {
    return out << ground.length_m << " m of " << ground.scenario;
  }
};

sim::Polyline FirstMetres(const sim::Polyline& points, double length_m) {
  sim::Polyline first = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    first.push_back(points[i]);
    if (sim::Length(first) < length_m) continue;
    first.back() = sim::PointAlong(points, length_m);
    break;
  }
  return first;
}

class PrintedMethod : public ::testing::TestWithParam<Ground> {};

TEST_P(PrintedMethod, FollowsAsThePaperSays) {
  const Ground& ground = GetParam();
  TrialOptions options;
  options.scenario = ground.scenario;
  options.methods = {"paper"};
  options.same_robot = true;
  options.trials = 1;
  options.seed = 11;
  auto setup = PrepareTrials(options);
  ASSERT_TRUE(setup.has_value()) << setup.error().message;
  setup->path.points = FirstMetres(setup->path.points, ground.length_m);
  const auto outcomes = RunTrials(*setup, options, nullptr);
  ASSERT_TRUE(outcomes.has_value()) << outcomes.error().message;
  const TrialRow& row = outcomes->front().row;
  EXPECT_TRUE(row.arrived) << TrialTable({row});
  EXPECT_LT(row.verdict.final_error_m, ground.final_m) << TrialTable({row});
  EXPECT_LT(row.verdict.max_path_error_m, ground.max_m) << TrialTable({row});
  EXPECT_GE(row.found_share, 0.85) << TrialTable({row});
}

INSTANTIATE_TEST_SUITE_P(Outdoors, PrintedMethod,
                         ::testing::Values(Ground{"paved", 15.0, 0.5, 0.5},
                                           Ground{"rough", 13.0, 0.9, 0.4}),
                         [](const auto& test) { return std::string(test.param.scenario); });

}  // namespace
}  // namespace trailcast::trial
