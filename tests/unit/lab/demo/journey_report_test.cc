#include "services/lab/demo/journey_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temp_dir.h"

namespace trailcast::demo {
namespace {

using mission::State;
using ::testing::HasSubstr;
using ::testing::Not;

class JourneyReportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto plan = PlanNetwork(folder_.path(), 1);
    ASSERT_TRUE(plan) << plan.error().message;
    plan_ = *std::move(plan);
    plan_.goal_m = 9.9;
    for (const DemoRobot& robot : plan_.robots) {
      if (robot.carry.empty()) {
        Drive(robot, 0.0, robot.is_scout() ? 0.0 : kBeside_m);
      } else {
        DriveAndBeCarried(robot, {9.0, 5.0});
      }
    }
  }
  [[nodiscard]] Result<JourneyReport> Judge(const std::vector<JourneyEnd>& ends) const {
    return JudgeJourneys(plan_, ends);
  }
  // Ten metres along x, from there.
  static void Drive(const DemoRobot& robot, double x_m, double y_m) {
    std::ofstream out(robot.truth);
    out << "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i <= 100; ++i) out << fmt::format("{},{},{},0\n", i, x_m + 0.1 * i, y_m);
  }
  // Two metres, and one more from where it was carried to.
  static void DriveAndBeCarried(const DemoRobot& robot, const Eigen::Vector2d& to_m) {
    std::ofstream out(robot.truth);
    out << "t_s,x_m,y_m,heading_rad\n";
    for (int i = 0; i <= 20; ++i) out << fmt::format("{},{},{},0\n", i, 0.1 * i, kBeside_m);
    for (int i = 0; i <= 10; ++i) {
      out << fmt::format("{},{},{},0\n", 21 + i, to_m.x() + 0.1 * i, to_m.y());
    }
  }
  // Returns the journey of the robot that is to be carried off.
  [[nodiscard]] std::size_t Carried() const {
    std::size_t carried = 0;
    while (Sent(carried).carry.empty()) ++carried;
    return carried;
  }
  [[nodiscard]] std::size_t Other() const { return Carried() == 0 ? 1 : 0; }
  [[nodiscard]] const DemoRobot& Sent(std::size_t journey) const {
    return plan_.robots[plan_.journeys[journey].robot];
  }
  // In words that say nothing.
  [[nodiscard]] static JourneyEnd In(mission::State state, const std::string& said = "xyzzy") {
    return {.said = said, .last = mission::Report{.state = state}};
  }
  // But for who was carried off.
  [[nodiscard]] std::vector<JourneyEnd> AllArrive() const {
    std::vector<JourneyEnd> ends;
    for (std::size_t i = 0; i < plan_.journeys.size(); ++i) {
      ends.push_back(In(Sent(i).carry.empty() ? State::kArrived : State::kFailed));
    }
    return ends;
  }
  static constexpr double kBeside_m = 0.35;  // taught paths, and with it what is closed

  test::TempDir folder_;
  NetworkPlan plan_;
};

TEST_F(JourneyReportTest, WhoSaysSoAndStandsAtTheGoalHasArrived) {
  const auto report = Judge(AllArrive());
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->AllWell());
  EXPECT_TRUE(report->rows[Other()].arrived);
  EXPECT_EQ(report->taught.size(), 3U);
  EXPECT_THAT(JourneyTable(*report), Not(HasSubstr("FAILED")));
  // The path of the robot that was carried off is in two parts.
  EXPECT_EQ(JourneyPaths(plan_, *report).size(), plan_.robots.size() + 1);
}

TEST_F(JourneyReportTest, WhoSaysSoElsewhereHasNotArrivedNorWhoSaysWhyNot) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < plan_.journeys.size(); ++i) {
    if (i != Carried()) others.push_back(i);
  }
  Drive(Sent(others[0]), 0.2, 0.6);
  auto ends = AllArrive();
  ends[others[1]] = In(State::kFailed, "LOST: not where it is said to stand");
  const auto report = Judge(ends);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->AllWell());
  EXPECT_FALSE(report->rows[others[0]].arrived);
  EXPECT_NEAR(report->rows[others[0]].beside_m, 0.63, 0.02);
  EXPECT_FALSE(report->rows[others[1]].well());
  EXPECT_TRUE(report->rows[others[2]].arrived);
  EXPECT_THAT(JourneyTable(*report), HasSubstr("LOST: not where it is said to stand"));
}

TEST_F(JourneyReportTest, ARobotThatWasNeverSentHasNotArrived) {
  const auto report = Judge({});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->AllWell());
  EXPECT_FALSE(report->rows[0].arrived);
  EXPECT_THAT(JourneyTable(*report), HasSubstr("it was not sent"));
}

TEST_F(JourneyReportTest, WhoWasCarriedOffMayGiveUpAndSayWhy) {
  const auto report = Judge(AllArrive());
  ASSERT_TRUE(report) << report.error().message;
  const JourneyRow& row = report->rows[Carried()];
  EXPECT_TRUE(row.carried());
  EXPECT_TRUE(row.well());
  EXPECT_FALSE(row.arrived);
  EXPECT_THAT(
      JourneyTable(*report),
      HasSubstr("was carried off after 2.0 m, to 9.0,5.0; it drove on for 1.0 m and said: "));
}

TEST_F(JourneyReportTest, WhoWasCarriedOffMayWaitForAWayAndForNothingElse) {
  auto ends = AllArrive();
  ends[Carried()] = In(State::kFetching, "waits for a way: ..");
  EXPECT_FALSE(Judge(ends)->rows[Carried()].well());
  ends[Carried()] = In(State::kFetching);
  ends[Carried()].last->waits_for = mission::WaitsFor::kWay;
  EXPECT_TRUE(Judge(ends)->rows[Carried()].well());
}

TEST_F(JourneyReportTest, WhoWasCarriedOffMayNotSayThatItHasArrivedElsewhere) {
  auto ends = AllArrive();
  ends[Carried()] = In(State::kArrived);
  auto report = Judge(ends);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->rows[Carried()].well());
  DriveAndBeCarried(Sent(Carried()), {8.9, 0.1});
  report = Judge(ends);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->rows[Carried()].well()) << "it found itself";
}

TEST_F(JourneyReportTest, WhoWasToBeCarriedOffAndWasNotShowsNothing) {
  Drive(Sent(Carried()), 0.0, kBeside_m);
  auto ends = AllArrive();
  ends[Carried()] = In(State::kArrived);
  const auto report = Judge(ends);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->AllWell());
  EXPECT_THAT(JourneyTable(*report), HasSubstr("was to be carried off"));
}

TEST_F(JourneyReportTest, NobodyDrivesOnWhatIsClosed) {
  Drive(Sent(Other()), 0.0, 0.25);
  const auto report = Judge(AllArrive());
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->rows[Other()].arrived);
  EXPECT_FALSE(report->AllWell());
  EXPECT_THAT(JourneyTable(*report), HasSubstr(Sent(Other()).name + " drove on what was closed"));
}

TEST_F(JourneyReportTest, AScoutThatDidNotDriveSoFarIsToldOf) {
  plan_.goal_m = 10.5;
  const auto report = Judge(AllArrive());
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
