#include <gmock/gmock.h>

#include "services/lab/trial/flaws.h"
#include "services/lab/trial/trial_batch.h"
#include "tests/scenario/lab/picture_hall.h"

namespace trailcast::trial {
namespace {

// One small trial of each of real robots' flaws: half round the hall, or standing where it
// cannot go on, and saying so.
TEST(FlawedRobots, ArriveOrStandAndSayWhy) {
  TrialOptions options;
  options.trials = 1;
  options.flaws = FlawNames();
  auto setup = PrepareTrials(options);
  ASSERT_TRUE(setup) << setup.error().message;
  setup->world = test::PictureHall();
  const sim::Polyline round = test::RoundTheHall();
  setup->path.points = {round.begin(), round.begin() + 6};  // two bends
  const auto outcomes = RunTrials(*setup, options, nullptr);
  ASSERT_TRUE(outcomes) << outcomes.error().message;
  ASSERT_EQ(outcomes->size(), FlawNames().size());
  for (const TrialOutcome& outcome : *outcomes) {
    const TrialRow& row = outcome.row;
    EXPECT_LT(row.verdict.max_path_error_m, 0.3) << TrialTable({row});
    if (row.flaw == "all") {
      EXPECT_TRUE(row.arrived || (row.state == "lost" && !row.reason.empty())) << TrialTable({row});
      continue;
    }
    EXPECT_TRUE(row.arrived) << TrialTable({row});
    EXPECT_LT(row.verdict.final_error_m, 0.25) << TrialTable({row});
  }
}

}  // namespace
}  // namespace trailcast::trial
