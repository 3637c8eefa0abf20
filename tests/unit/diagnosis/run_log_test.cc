#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "agent/diagnosis/run_log_format.h"
#include "agent/diagnosis/run_log_reader.h"
#include "tests/support/sample_run.h"
#include "tests/support/temp_dir.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

Result<RunLog> Read(const std::string& text) {
  std::istringstream stream(text);
  return ReadRunLog(stream);
}

FrameRow FullRow() {
  FrameRow row;
  row.frame = 12345;
  row.t_s = 411.503;
  row.segment = 117;
  row.fraction = 0.125;
  row.progress = 0.9876;
  row.phase = Phase::kCovered;
  row.stored = 29;
  row.tracked = 21;
  row.agreeing = 18;
  row.rejected = 3;
  row.rejected_by_px = 17.0;
  row.left_picture = 2;
  row.not_returned = 1;
  row.turn_rad = -0.131;
  row.vision_turn_rad = -0.25;
  row.odometry_turn_rad = 0.012;
  row.delta = 0.75;
  row.delta_minus = 0.5;
  row.left_m = -0.043;
  row.left_sigma_m = 0.008;
  row.heading_rad = -0.019;
  row.along_m = 1.713;
  row.mount_yaw_rad = 0.035;
  row.magnification = 0.524;
  row.driven_m = 151.25;
  row.x_m = -103.5;
  row.y_m = 42.125;
  row.linear_mps = 0.386;
  row.angular_radps = -0.058;
  row.cpu_ms = 12.25;
  row.true_off_m = 0.062;
  row.place = 0.25;
  row.place_sigma = 0.0125;
  row.off_route = 0.125;
  return row;
}

TEST(RunLog, ARowComesBackAsItWasWritten) {
  const std::string text = FirstLine() + HeaderText({}) + RowText(FullRow());
  const auto log = Read(text);
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->frames.size(), 1U);
  // Every column's text is the same again: none is lost, none in another's place.
  EXPECT_EQ(RowText(log->frames.front()), RowText(FullRow()));
  EXPECT_EQ(log->frames.front().phase, Phase::kCovered);
  EXPECT_DOUBLE_EQ(*log->frames.front().left_m, -0.043);
}

TEST(RunLog, WhatARobotDoesNotHaveStaysEmpty) {
  FrameRow row;
  row.turn_rad = std::numeric_limits<double>::quiet_NaN();
  const auto log = Read(FirstLine() + HeaderText({}) + RowText(row));
  ASSERT_EQ(log->frames.size(), 1U);
  EXPECT_FALSE(log->frames.front().left_m);
  EXPECT_FALSE(log->frames.front().driven_m);
  EXPECT_EQ(log->frames.front().turn_rad, 0.0);
}

TEST(RunLog, AFrameTakesLessThanTwoHundredBytes) { EXPECT_LT(RowText(FullRow()).size(), 200U); }

TEST(RunLog, EventsAndHeaderComeBack) {
  RunEvent event{7, 0.233, "hand-over", {}, "one line: with = and : in it\nand no second"};
  event.fields.Add("segment", "3");
  event.fields.Add("search", "near by");
  Fields header;
  header.Add("scout_camera", "webcam 320x240");
  const auto log = Read(FirstLine() + HeaderText(header) + EventText(event));
  ASSERT_TRUE(log);
  EXPECT_EQ(log->header.Find("scout_camera"), "webcam 320x240");
  ASSERT_EQ(log->events.size(), 1U);
  const RunEvent& read = log->events.front();
  EXPECT_EQ(read.frame, 7);
  EXPECT_EQ(read.what, "hand-over");
  EXPECT_EQ(read.fields.Number("segment"), 3.0);
  EXPECT_EQ(read.fields.Find("search"), "near_by");
  EXPECT_EQ(read.text, "one line: with = and : in it and no second");
  EXPECT_EQ(log->damaged_lines, 0U);
}

TEST(RunLog, CutOffAnywhereItIsReadAsFarAsItIsWhole) {
  test::SampleRun run;
  const std::size_t header = run.text().size();
  run.HandOver(0, 25).Frames(3).End("ARRIVED", "at the end");
  for (std::size_t size = header; size <= run.text().size(); ++size) {
    const std::string text = run.text().substr(0, size);
    const auto log = Read(text);
    ASSERT_TRUE(log) << size;
    const auto lines =
        static_cast<std::size_t>(std::count(text.begin() + header, text.end(), '\n'));
    const std::size_t whole = log->frames.size() + log->events.size() + (log->ending ? 1 : 0);
    EXPECT_EQ(whole, lines) << size;
    EXPECT_EQ(log->damaged_lines, text.back() == '\n' ? 0U : 1U) << size;
    EXPECT_EQ(log->ending.has_value(), size == run.text().size());
  }
}

TEST(RunLog, DamagedLinesAreNamedAndTheOthersKept) {
  test::SampleRun run;
  run.Frames(6);
  std::vector<std::string> lines;
  std::istringstream stream(run.text());
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const std::size_t first = lines.size() - 6;  // the first row
  lines[first + 1][0] = 'x';                   // no number
  lines[first + 2].resize(40);                 // values are missing
  lines[first + 3] = std::string("\0\x01\xff", 3);
  lines[first + 4] = std::string(kLongestLogLine + 1, '7');
  std::string text;
  for (const std::string& line : lines) text.append(line).append(1, '\n');
  const auto log = Read(text);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->frames.size(), 2U);
  EXPECT_EQ(log->damaged_lines, 4U);
  ASSERT_EQ(log->damage.size(), 4U);
  EXPECT_EQ(log->damage[0].line, first + 2);
  EXPECT_THAT(log->damage[0].what, HasSubstr("is no frame"));
  EXPECT_THAT(log->damage[1].what, HasSubstr("columns"));
  EXPECT_THAT(log->damage[3].what, HasSubstr("longer than"));
}

TEST(RunLog, FramesThatGoBackAreDamage) {
  test::SampleRun run;
  run.Frames(3);
  run.row().frame = 1;
  run.Frame();
  EXPECT_EQ(run.Log().frames.size(), 3U);
  EXPECT_THAT(run.Log().damage.at(0).what, HasSubstr("frame 1 after frame 2"));
}

TEST(RunLog, EndlessDamageIsCountedAndNotKept) {
  std::string text = test::SampleRun().text();
  for (int i = 0; i < 1000; ++i) text += "?\n";
  const auto log = Read(text);
  EXPECT_EQ(log->damaged_lines, 1000U);
  EXPECT_LT(log->damage.size(), 100U);
}

TEST(RunLog, NoMoreIsReadThanTheLimitsSay) {
  test::SampleRun run;
  run.HandOver(0, 20).HandOver(1, 20).HandOver(2, 20).Frames(50);
  std::istringstream stream(run.text());
  const auto log = ReadRunLog(stream, {.lines = 40, .events = 2});
  ASSERT_TRUE(log);
  EXPECT_LT(log->frames.size(), 40U);
  EXPECT_EQ(log->events.size(), 2U);
  EXPECT_THAT(log->damage.back().what, HasSubstr("more lines than are read"));
}

TEST(RunLog, ItsEndsAreReadByThemselves) {
  const test::TempDir folder;
  test::SampleRun run;
  run.HandOver(0, 20).Frames(3000).End("ARRIVED", "there");
  std::ofstream(folder / "run.log") << run.text();
  const auto ends = ReadRunEnds(folder / "run.log");
  ASSERT_TRUE(ends) << ends.error().message;
  EXPECT_EQ(ends->header.Find("route"), "hall");
  EXPECT_EQ(ends->frames.front().frame, 0);
  EXPECT_EQ(ends->frames.back().frame, 3000);
  EXPECT_LT(ends->frames.size(), 2000U) << "of a longer log";
  ASSERT_TRUE(ends->ending);
  EXPECT_EQ(ends->ending->text, "there");

  run = test::SampleRun();
  run.HandOver(0, 20).Frames(30);
  std::ofstream(folder / "short.log") << run.text();
  const auto brief = ReadRunEnds(folder / "short.log");
  ASSERT_TRUE(brief);
  EXPECT_EQ(brief->frames.size(), 31U);
  EXPECT_FALSE(brief->ending);
  std::ofstream(folder / "other.log") << "2026 something else";
  EXPECT_FALSE(ReadRunEnds(folder / "other.log"));
}

TEST(RunLog, ANewerVersionsExtraColumnIsPassedOver) {
  std::string header = HeaderText({});
  header.insert(header.size() - 1, " mood");
  std::string row = RowText(FullRow());
  row.insert(row.size() - 1, " cheerful");
  const auto log = Read(FirstLine() + header + row);
  ASSERT_EQ(log->frames.size(), 1U);
  EXPECT_EQ(RowText(log->frames.front()), RowText(FullRow()));
}

TEST(RunLog, SaysWhichColumnIsMissing) {
  const auto log = Read(FirstLine() + "# columns frame t_s\n0 0.0\n");
  ASSERT_TRUE(log);
  EXPECT_TRUE(log->frames.empty());
  EXPECT_THAT(log->damage.at(0).what, HasSubstr("no column 'segment'"));
}

TEST(RunLog, OtherFilesAndOtherVersionsAreRefused) {
  for (const std::string text : {"", "frame,segment,progress\n0,0,0\n", "\x89PNG\r\n"}) {
    const auto log = Read(text);
    ASSERT_FALSE(log);
    EXPECT_EQ(log.error().code, ErrorCode::kCorrupt);
    EXPECT_THAT(log.error().message, HasSubstr("not a replay's log"));
  }
  const auto newer = Read("# trailcast replay log 2\n");
  ASSERT_FALSE(newer);
  EXPECT_THAT(newer.error().message, HasSubstr("version '2'; this program reads 1"));
}

}  // namespace
}  // namespace trailcast::agent
