#include "services/lab/trial/judge/recording_csv.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"
#include "tests/unit/lab/trial/recording_rows.h"

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(RecordingCsv, SharesAreUnderTheirNamesAndEmptyWhereNothingWasJudged) {
  RecordingRow row = test::Judged("hall/b", "every=3");
  row.verdict.lost = 25;
  row.verdict.wrong = 5;
  EXPECT_THAT(RecordingCsvHeader(),
              StartsWith("set,kind,teach,replay,disturb,method,following_share,right_share,"
                         "wrong_share,lost_share,arrived,side_share,correction_share,"
                         "steering_share,found_share,state,error,segments,frames"));
  EXPECT_THAT(RecordingCsvLine(row),
              StartsWith("tuned,right,hall/teach,hall/b,every=3,default,1.0000,1.0000,0.1000,"
                         "0.2500,1,,,,,ARRIVED,,7,100,100,25,50,50,5,"));
}

TEST(RecordingCsv, WhatWasWrittenIsReadAgain) {
  RecordingRow row = test::Judged("hall, upstairs/b", "none", PairKind::kWrong);
  row.error = "frame 7: resize, \"inv_scale_x > 0\"";
  Verdict& verdict = row.verdict;
  verdict.arrived = false;
  verdict.sided = 9;
  verdict.side_right = 8;
  verdict.corrected = 7;
  verdict.correction_right = 6;
  verdict.steered = 5;
  verdict.steered_alike = 4;
  verdict.offs = 3;
  verdict.found_in_time = 2;
  verdict.found_s = {0.5, 1.25};
  const test::TempDir folder;
  ASSERT_TRUE(WriteRecordingCsv({test::Judged("hall/b"), row}, folder / "out.csv"));
  EXPECT_TRUE(IsRecordingCsv(folder / "out.csv"));
  const auto read = ReadRecordingCsv(folder / "out.csv");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(RecordingCsvLine((*read)[1]), RecordingCsvLine(row));
  EXPECT_EQ((*read)[1].error, row.error);
  EXPECT_EQ((*read)[1].kind, PairKind::kWrong);
  EXPECT_THAT((*read)[1].verdict.found_s, ElementsAre(0.5, 1.25));
}

TEST(RecordingCsv, SaysWhichLineIsNotAReplay) {
  const test::TempDir folder;
  const auto message = [&](const std::string& text) {
    std::ofstream(folder / "in.csv") << text;
    const auto read = ReadRecordingCsv(folder / "in.csv");
    return read ? std::string("no error") : read.error().message;
  };
  const std::string header = RecordingCsvHeader() + "\n";
  EXPECT_THAT(message("scenario,method\n"), HasSubstr("not a table of judged recordings"));
  EXPECT_FALSE(IsRecordingCsv(folder / "in.csv"));
  EXPECT_THAT(message(header + "tuned,right\n"), HasSubstr("line 2: expected"));
  std::string bad = RecordingCsvLine(test::Judged("hall/b"));
  bad.replace(bad.find(",7,"), 3, ",seven,");
  EXPECT_THAT(message(header + bad + "\n"), HasSubstr("line 2: segments is 'seven'"));
}

}  // namespace
}  // namespace trailcast::trial
