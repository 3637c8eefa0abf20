#include "agent/tool/trial_report.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "tests/support/temp_dir.h"

namespace trailcast::tool {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TrialRow EndedAt(double x_m, double y_m) {
  TrialRow row;
  row.scenario = "indoor";
  row.method = "default";
  row.scout_camera = "webcam";
  row.follower_camera = "wide";
  row.state = "arrived";
  row.arrived = true;
  row.end_m = {10.0, 5.0};
  row.verdict.final_m = row.end_m + Eigen::Vector2d(x_m, y_m);
  row.verdict.final_error_m = std::hypot(x_m, y_m);
  return row;
}

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

TEST(TrialCsv, BeginsWithTheAgreedColumnsInTheirOrder) {
  EXPECT_THAT(TrialCsvHeader(),
              StartsWith("scenario,method,scout_camera,follower_camera,trial,seed,arrived,"
                         "final_error_m,final_x_m,final_y_m,end_x_m,end_y_m,mean_path_error_m,"
                         "max_path_error_m,found_share,segments,bytes_per_m,ms_per_frame,state,"));
}

TEST(TrialCsv, ALineHasAsManyFieldsAsTheHeaderAndValuesUnderTheirNames) {
  TrialRow row = EndedAt(0.3, 0.4);
  row.trial = 2;
  row.seed = 8;
  row.segments = 6;
  row.found_share = 0.75;
  const std::string line = TrialCsvLine(row);
  const std::string header = TrialCsvHeader();
  EXPECT_EQ(std::count(line.begin(), line.end(), ','),
            std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(line, StartsWith("indoor,default,webcam,wide,2,8,1,0.5000,10.3000,5.4000,10.0000,"
                               "5.0000,0.0000,0.0000,0.7500,6,0.0,0.000,arrived,"));
}

TEST(TrialCsv, QuotesAReasonWithCommas) {
  TrialRow row = EndedAt(0.0, 0.0);
  row.reason = "too few features, \"blank\" wall";
  EXPECT_THAT(TrialCsvLine(row), HasSubstr(",\"too few features, \"\"blank\"\" wall\""));
}

TEST(TrialCsv, IsWrittenWholeAndSaysWhereItCannotBe) {
  const test::TempDir folder;
  ASSERT_TRUE(WriteTrialCsv({EndedAt(0.0, 0.0)}, folder / "out.csv").has_value());
  std::ifstream in(folder / "out.csv");
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), TrialCsvHeader() + "\n" + TrialCsvLine(EndedAt(0.0, 0.0)) + "\n");
  const Result<void> refused = WriteTrialCsv({}, folder.path() / "absent" / "out.csv");
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, HasSubstr("absent/out.csv"));
}

TEST(TrialTable, ShowsThePapersFiguresOnlyForThePapersScenarios) {
  TrialRow row = EndedAt(0.0, 0.0);
  EXPECT_THAT(TrialTable({row}), HasSubstr("the paper"));
  row.scenario = "bookstore";
  EXPECT_THAT(TrialTable({row}), Not(HasSubstr("the paper")));
}

}  // namespace
}  // namespace trailcast::tool
