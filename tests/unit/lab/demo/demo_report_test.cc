#include "services/lab/demo/demo_report.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::demo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Robots whose processes have left their files: a scout that drove 10 m along x, and a follower.
class DemoReportTest : public ::testing::Test {
 protected:
  DemoReportTest() {
    robots_.resize(2);
    robots_[0] = Robot("scout", true);
    robots_[1] = Robot("follower-1", false);
    WriteTruth(robots_[0], 10.0, 0.0);
    WriteText(robots_[0].report, "segments=5\nbytes_per_m=3000\nunreceipted=0\n");
    WriteTruth(robots_[1], 10.0, 0.2);
    WriteText(robots_[1].report, Arrived());
  }
  static std::string Arrived() {
    return "arrived=1\nstate=ARRIVED\nreason=\nsegments=5\nfound_share=0.8500\nbytes_per_m=3000\n";
  }
  DemoRobot Robot(const std::string& name, bool scout) const {
    return {name,
            "webcam",
            "webcam",
            1,
            scout ? DemoRobot::Task::kTeach : DemoRobot::Task::kFollow,
            kDemoRoute,
            {},
            folder_ / (name + ".csv"),
            folder_ / (name + ".txt")};
  }
  static void WriteText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
  }
  // Straight along x, `off_m` to the left, two frames a second.
  static void WriteTruth(const DemoRobot& robot, double length_m, double off_m) {
    std::ofstream out(robot.truth);
    out << "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i <= 50; ++i) {
      out << 3.0 + 0.5 * i << ',' << length_m * i / 50.0 << ',' << off_m << ",0.0\n";
    }
  }
  std::vector<DemoRow> Judge(ExitStatus follower = {}) {
    return JudgeDemo(robots_, {ExitStatus{}, follower});
  }

  test::TempDir folder_;
  std::vector<DemoRobot> robots_;
};

TEST_F(DemoReportTest, AFollowerIsJudgedByTheScoutsTruePath) {
  const std::vector<DemoRow> rows = Judge();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_TRUE(rows[0].arrived);
  EXPECT_TRUE(rows[1].arrived) << rows[1].why_not;
  EXPECT_NEAR(rows[1].verdict.final_error_m, 0.2, 1e-6);
  EXPECT_NEAR(rows[1].verdict.mean_path_error_m, 0.2, 1e-6);
  EXPECT_NEAR(rows[1].duration_s, 25.0, 1e-6);
  const std::string table = DemoTable(rows);
  EXPECT_THAT(table, HasSubstr("85 %"));
  EXPECT_THAT(table, Not(HasSubstr("did not arrive")));
}

TEST_F(DemoReportTest, WhoSaysItArrivedElsewhereHasNotArrived) {
  WriteTruth(robots_[1], 7.0, 0.0);
  const std::vector<DemoRow> rows = Judge();
  EXPECT_FALSE(rows[1].arrived);
  EXPECT_THAT(DemoTable(rows),
              HasSubstr("follower-1 did not arrive: says it arrived, but 3.0 m from the end"));
}

TEST_F(DemoReportTest, WhoGaveUpIsShownWithItsReason) {
  WriteText(robots_[1].report, "arrived=0\nstate=LOST\nreason=too few features\n");
  EXPECT_THAT(DemoTable(Judge({3, 0})),
              HasSubstr("follower-1 did not arrive: LOST: too few features"));
}

TEST_F(DemoReportTest, AProcessThatLeftNothingIsShownWithHowItEnded) {
  std::filesystem::remove(robots_[1].truth);
  const std::vector<DemoRow> rows = Judge({0, 11});
  EXPECT_FALSE(rows[1].arrived);
  EXPECT_THAT(DemoTable(rows), HasSubstr("its process ended by signal 11"));
}

TEST_F(DemoReportTest, AScoutThatCouldNotDeliverEverythingHasNotTaught) {
  WriteText(robots_[0].report, "segments=5\nbytes_per_m=3000\nunreceipted=2\n");
  EXPECT_FALSE(Judge()[0].arrived);
}

TEST_F(DemoReportTest, APathIsDrawnForEachRobotTheTaughtOneFirst) {
  const std::vector<plot::PlottedPath> paths = DemoPaths(Judge());
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_TRUE(paths[0].taught);
  EXPECT_FALSE(paths[1].taught);
  EXPECT_FALSE(paths[1].failed);
  EXPECT_GT(paths[1].points_m.size(), 10U);
}

TEST_F(DemoReportTest, ATruthFileWithADamagedLineIsRefusedWithItsNumber) {
  WriteText(robots_[0].truth, "t_s,x_m,y_m,heading_rad\n0,0,0,0\n0.5,x,0,0\n");
  const auto truth = ReadTruth(robots_[0].truth);
  ASSERT_FALSE(truth.has_value());
  EXPECT_THAT(truth.error().message, HasSubstr("line 3"));
}

}  // namespace
}  // namespace trailcast::demo
