#include "services/lab/trial/trial_report.h"

#include <gmock/gmock.h>

#include "tests/unit/lab/trial/trial_rows.h"

namespace trailcast::trial {
namespace {

using test::EndedAt;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Summarize, ACommonOffsetIsInaccurateButRepeatable) {
  const TrialSummary summary = Summarize({EndedAt(0.3, 0.4), EndedAt(0.3, 0.4)});
  EXPECT_NEAR(summary.accuracy_m, 0.5, 1e-9);
  EXPECT_NEAR(summary.repeatability_m, 0.0, 1e-9);
}

TEST(Summarize, OppositeErrorsAreAsUnrepeatableAsInaccurate) {
  const TrialSummary summary = Summarize({EndedAt(0.2, 0.0), EndedAt(-0.2, 0.0)});
  EXPECT_NEAR(summary.accuracy_m, 0.2, 1e-9);
  EXPECT_NEAR(summary.repeatability_m, 0.2, 1e-9);
}

TEST(Summarize, AFailedTrialCountsInEveryFigure) {
  TrialRow failed = EndedAt(-8.0, 0.0);
  failed.arrived = false;
  failed.verdict.max_path_error_m = 5.0;
  const TrialSummary summary = Summarize({EndedAt(0.0, 0.0), failed});
  EXPECT_EQ(summary.arrived, 1);
  EXPECT_EQ(summary.trials, 2);
  EXPECT_NEAR(summary.largest_final_error_m, 8.0, 1e-9);
  EXPECT_NEAR(summary.accuracy_m, 8.0 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(summary.max_path_error_m, 5.0, 1e-9);
}

TEST(TrialTable, ShowsThePapersFiguresOnlyForThePapersScenarios) {
  TrialRow row = EndedAt(0.0, 0.0);
  EXPECT_THAT(TrialTable({row}), HasSubstr("the paper"));
  row.scenario = "bookstore";
  EXPECT_THAT(TrialTable({row}), Not(HasSubstr("the paper")));
}

TEST(TrialTable, TellsVisitsOneAfterTheOther) {
  std::vector<TrialRow> rows = {EndedAt(0.3, 0.4), EndedAt(0.0, 0.0), EndedAt(0.0, 0.0)};
  rows[0].visit = 1;
  rows[0].refreshed = refresh::RefreshCounts{10, 2, 0, 3, 4};
  rows[1].visit = rows[2].visit = 2;
  rows[2].arrived = false;
  const std::string text = TrialTable(rows);
  EXPECT_THAT(text, HasSubstr("    1      1/1    0.500"));
  EXPECT_THAT(text, HasSubstr("       4        3\n"));
  EXPECT_THAT(text, HasSubstr("    2      1/2    0.000"));
  EXPECT_THAT(TrialTable({EndedAt(0.0, 0.0)}), Not(HasSubstr("refreshed")));
}

TEST(TrialMarkdown, PutsTableOneBesideThePaperAndEveryCaseBelow) {
  TrialRow ours = EndedAt(0.3, 0.4);
  TrialRow paper = ours;
  paper.method = "paper";
  TrialRow shop = ours;
  shop.scenario = "bookstore";
  const std::string text = TrialMarkdown({ours, paper, shop});
  EXPECT_THAT(text, HasSubstr("| `indoor` | `paper` | 1 of 1 | 0.50 / 0.00, 0.50 | "
                              "0.14 / 0.08, 0.23 |"));
  EXPECT_THAT(text, HasSubstr("| `indoor` | default  webcam > wide | 1 of 1 | 0.500 |"));
  EXPECT_THAT(text, HasSubstr("| `bookstore` | default  webcam > wide | 1 of 1 | 0.500 |"));
  EXPECT_THAT(text, Not(HasSubstr("| `bookstore` | `default`")));
}

TEST(TrialMarkdown, KeepsTheSameRobotsTrialsApartFromThoseOfTwo) {
  TrialRow two = EndedAt(0.3, 0.4);
  TrialRow one = EndedAt(0.0, 0.1);
  one.same_robot = true;
  const std::string text = TrialMarkdown({two, one});
  EXPECT_THAT(text, HasSubstr("| `indoor` | `default` | 1 of 1 | 0.50 / 0.00, 0.50 |"));
  EXPECT_THAT(text, HasSubstr("| `indoor`, same robot | `default` | 1 of 1 | 0.10 / 0.00, 0.10 |"));
  EXPECT_THAT(text, HasSubstr("webcam > wide, same robot | 1 of 1 | 0.100 |"));
}

}  // namespace
}  // namespace trailcast::trial
