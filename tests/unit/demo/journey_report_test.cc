#include "services/demo/journey_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::demo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class JourneyReportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto plan = PlanNetwork(folder_.path(), 1);
    ASSERT_TRUE(plan) << plan.error().message;
    plan_ = *std::move(plan);
    for (const DemoRobot& robot : plan_.robots) Drive(robot, 0.0, 0.0);
  }
  // Ten metres along x, from there.
  static void Drive(const DemoRobot& robot, double x_m, double y_m) {
    std::ofstream out(robot.truth);
    out << "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i <= 100; ++i) out << fmt::format("{},{},{},0\n", i, x_m + 0.1 * i, y_m);
  }
  [[nodiscard]] const DemoRobot& Sent(std::size_t journey) const {
    return plan_.robots[plan_.journeys[journey].robot];
  }
  [[nodiscard]] std::vector<std::string> AllSay(const std::string& what) const {
    std::vector<std::string> said;
    for (std::size_t i = 0; i < plan_.journeys.size(); ++i) {
      said.push_back(Sent(i).name + ": " + what);
    }
    return said;
  }

  test::TempDir folder_;
  NetworkPlan plan_;
};

TEST_F(JourneyReportTest, WhoSaysSoAndStandsAtTheGoalHasArrived) {
  const auto report = JudgeJourneys(plan_, 9.9, AllSay("arrived"));
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->AllArrived());
  EXPECT_EQ(report->taught.size(), 3U);
  EXPECT_THAT(JourneyTable(*report), Not(HasSubstr("FAILED")));
  EXPECT_EQ(JourneyPaths(plan_, *report).size(), plan_.robots.size());
}

TEST_F(JourneyReportTest, WhoSaysSoElsewhereHasNotArrivedNorWhoSaysWhyNot) {
  Drive(Sent(0), 0.2, 0.6);
  auto said = AllSay("arrived");
  said[1] = Sent(1).name + ": failed: LOST: not where it is said to stand";
  const auto report = JudgeJourneys(plan_, 9.9, said);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->AllArrived());
  EXPECT_FALSE(report->rows[0].arrived);
  EXPECT_NEAR(report->rows[0].beside_m, 0.63, 0.02);
  EXPECT_FALSE(report->rows[1].arrived);
  EXPECT_TRUE(report->rows[2].arrived);
  EXPECT_THAT(JourneyTable(*report), HasSubstr("LOST: not where it is said to stand"));
}

TEST_F(JourneyReportTest, ARobotThatWasNeverSentHasNotArrived) {
  const auto report = JudgeJourneys(plan_, 9.9, {});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->rows[0].arrived);
  EXPECT_THAT(JourneyTable(*report), HasSubstr("it was not sent"));
}

TEST_F(JourneyReportTest, AScoutThatDidNotDriveSoFarIsToldOf) {
  const auto report = JudgeJourneys(plan_, 10.5, AllSay("arrived"));
  ASSERT_FALSE(report);
  EXPECT_THAT(report.error().message, HasSubstr("scout-1"));
}

// Each robot stands where the plan says, on the straight at its route's beginning.
TEST_F(JourneyReportTest, RobotsStandAlongTheRoutes) {
  ASSERT_EQ(plan_.journeys.size(), 5U);
  for (const NetworkPlan::Journey& journey : plan_.journeys) {
    const DemoRobot& robot = plan_.robots[journey.robot];
    EXPECT_THAT(journey.from, testing::StartsWith(robot.route + "@"));
    EXPECT_TRUE(std::filesystem::exists(robot.path));
  }
  EXPECT_NE(plan_.journeys[0].from, PlanNetwork(folder_.path(), 2)->journeys[0].from);
}

}  // namespace
}  // namespace trailcast::demo
