#include "services/lab/trial/judge/recording_report.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/unit/lab/trial/recording_rows.h"

namespace trailcast::trial {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

RecordingRow Right(double right_share, double wrong_share,
                   const std::string& disturbance = "none") {
  RecordingRow row = test::Judged("hall/b", disturbance);
  row.verdict.right = static_cast<int>(right_share * row.verdict.aligned);
  row.verdict.wrong = static_cast<int>(wrong_share * row.verdict.aligned);
  return row;
}

RecordingRow Elsewhere(int following, bool arrived, const std::string& set = "tuned") {
  RecordingRow row = test::Judged("yard/c", "none", PairKind::kWrong);
  row.set = set;
  row.verdict.following = following;
  row.verdict.arrived = arrived;
  row.verdict.aligned = row.verdict.right = 0;
  return row;
}

TEST(RecordingReport, NothingIsAShareOfNothing) {
  const RecordingShares shares = SharesOf({});
  EXPECT_FALSE(shares.following || shares.right || shares.wrong || shares.side || shares.found);
}

TEST(RecordingReport, TheTableHasALineForEachReplayAndSaysWhatEndedIt) {
  RecordingRow ended = test::Judged("hall/c", "crop=0.15");
  ended.error = "frame 19: cannot go on";
  ended.verdict.offs = 4;
  ended.verdict.found_in_time = 3;
  const std::string table = RecordingTable({test::Judged("hall/b"), ended});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_THAT(table, AllOf(HasSubstr("hall/b on hall/teach"), HasSubstr("ARRIVED"),
                           HasSubstr("3 of 4"), HasSubstr("frame 19: cannot go on")));
}

TEST(RecordingReport, MarkdownTellsLeastMeanAndMostBesideTheGoals) {
  const std::string page = RecordingMarkdown({Right(0.9, 0.02), Right(0.5, 0.1)});
  EXPECT_THAT(page, HasSubstr("| measure | goal | tuned |\n| --- | --- | --- |\n"));
  EXPECT_THAT(page, HasSubstr("within 5 %, least (mean) | 0.90 (0.95) | 0.500 (0.700) |"));
  EXPECT_THAT(page, HasSubstr("at a wrong place, most | 0.01 | 0.100 |"));
}

TEST(RecordingReport, MarkdownHasAColumnForEachSet) {
  const std::string page = RecordingMarkdown(
      {Elsewhere(0, false), Elsewhere(10, true), Elsewhere(50, true, "held out")});
  EXPECT_THAT(page, HasSubstr("| measure | goal | tuned | held out |"));
  EXPECT_THAT(page, HasSubstr("| 0.001; 0 | 0.050; 1 of 2 | 0.500; 1 of 1 |"));
}

TEST(RecordingReport, DisturbedReplaysHaveLinesOfTheirOwn) {
  RecordingRow jumped = Right(0.4, 0.3, "jump=3");
  jumped.verdict.offs = 4;
  jumped.verdict.found_in_time = 1;
  const std::string page = RecordingMarkdown({Right(1.0, 0.0), Right(0.8, 0.02, "camera"), jumped});
  EXPECT_THAT(page, HasSubstr("least (mean) | 0.90 (0.95) | 1.000 (1.000) |"));
  EXPECT_THAT(page, HasSubstr("| `camera`: within 5 %, least (mean), wrong place, most | 0.90, "
                              "0.02 | 0.800 (0.800), 0.020 |"));
  EXPECT_THAT(page, HasSubstr("| `jump=3`: within 5 %"));
  EXPECT_THAT(page, HasSubstr("found again after a cut, within 2 s | 0.95 | 0.250 |"));
  EXPECT_THAT(page, Not(HasSubstr("`none`")));
}

}  // namespace
}  // namespace trailcast::trial
