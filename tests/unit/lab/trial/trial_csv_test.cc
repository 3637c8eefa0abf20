#include "services/lab/trial/trial_csv.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "tests/support/temp_dir.h"
#include "tests/unit/lab/trial/trial_rows.h"

namespace trailcast::trial {
namespace {

using test::EndedAt;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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

TEST(TrialCsv, WhatWasWrittenIsReadAgain) {
  const test::TempDir folder;
  TrialRow pushed = EndedAt(0.3, 0.4);
  pushed.push_m = -2.0;
  pushed.same_robot = true;
  pushed.flaw = "upside-down";
  pushed.verdict.after_push_m = 0.125;
  pushed.verdict.p90_path_error_m = 0.25;
  pushed.lap_ends_m = {0.05, 0.0625};
  pushed.reason = "lost, \"blank\" wall";
  const std::vector<TrialRow> rows = {EndedAt(0.1, 0.0), pushed};
  ASSERT_TRUE(WriteTrialCsv(rows, folder / "out.csv"));
  const auto read = ReadTrialCsv(folder / "out.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(TrialCsvLine((*read)[i]), TrialCsvLine(rows[i]));
  }
  EXPECT_EQ((*read)[1].flaw, "upside-down");
  EXPECT_EQ((*read)[1].verdict.p90_path_error_m, 0.25);
  EXPECT_EQ((*read)[1].lap_ends_m, (std::vector<double>{0.05, 0.0625}));
}

TEST(TrialCsv, SaysWhichLineIsNotATrial) {
  const test::TempDir folder;
  const auto message = [&](const std::string& text) {
    std::ofstream(folder / "in.csv") << text;
    const auto read = ReadTrialCsv(folder / "in.csv");
    return read ? std::string("no error") : read.error().message;
  };
  const std::string header = TrialCsvHeader() + "\n";
  const std::string good = TrialCsvLine(EndedAt(0.0, 0.0)) + "\n";
  EXPECT_THAT(message("x_m,y_m\n"), HasSubstr("not a table of trials"));
  EXPECT_THAT(message(header + good + "indoor,default\n"), HasSubstr("line 3: expected 31 cells"));
  std::string bad = good;
  bad.replace(bad.find("10.0000"), 7, "far");
  EXPECT_THAT(message(header + bad), HasSubstr("line 2: final_x_m is 'far', expected a number"));
}

}  // namespace
}  // namespace trailcast::trial
