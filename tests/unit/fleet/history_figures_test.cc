#include "services/fleet/history_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::fleet {
namespace {

using mission::State;

constexpr std::int64_t kMonday_ms = 1'700'481'600'000;  // 2023-11-20 12:00 UTC
constexpr std::int64_t kWeek_ms = std::int64_t{7} * 24 * 3600 * 1000;

mission::Record Of(const std::string& robot, const std::string& orders, State state,
                   std::uint32_t task = 0, std::int64_t sent_unix_ms = kMonday_ms) {
  return {
      .mission = {.agent = AgentId(robot), .id = "m", .orders = orders},
      .last = {.agent = AgentId(robot), .mission = "m", .change = 3, .state = state, .task = task},
      .sent_unix_ms = sent_unix_ms,
      .changed_unix_ms = sent_unix_ms + 60'000};
}

mission::GivenCommand Given(mission::NowOrder order, const std::string& robot, std::int64_t unix_ms,
                            bool refused = false) {
  return {.command = {.order = order},
          .answers = {{.agent = AgentId(robot), .refused = refused}},
          .given_unix_ms = unix_ms};
}

const std::map<std::string, double> kLengths_m{{"hall", 20.0}};

TEST(HistoryFigures, MetresAreThoseOfTheOrdersThatWereDone) {
  const std::vector<mission::Record> missions{
      Of("robot1", "follow hall", State::kArrived),
      Of("robot1", "follow hall 3..10 laps 2 wait 5 follow yard", State::kFailed, 2),
      Of("robot2", "follow hall 5.. follow hall backwards ..15 follow hall backwards 15..12",
         State::kArrived),
      Of("robot3", "goto bay way 2 follow hall 4..6 follow yard backwards 5..1", State::kArrived)};
  EXPECT_THAT(RoutesToMeasure(missions), testing::ElementsAre("hall"));
  const auto figures = FiguresOf(missions, {}, kLengths_m, FiguresBy::kRobot);
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_DOUBLE_EQ(figures.at("robot1").metres, 20.0 + 14.0);
  EXPECT_EQ(figures.at("robot1").missions, 2U);
  EXPECT_EQ(figures.at("robot1").arrived, 1U);
  EXPECT_EQ(figures.at("robot1").interventions, 1U) << "it failed";
  EXPECT_DOUBLE_EQ(figures.at("robot2").metres, 15.0 + 5.0 + 3.0);
  EXPECT_DOUBLE_EQ(figures.at("robot3").metres, 2.0 + 4.0);
  EXPECT_DOUBLE_EQ(FiguresOf(missions, {}, {}, FiguresBy::kRobot).at("robot1").metres, 14.0)
      << "how long hall is, is not known";
}

TEST(HistoryFigures, WhatIsUnderWayOrNoRobotTookDoesNotCount) {
  mission::Record expired = Of("robot1", "follow hall", State::kExpired);
  expired.last.change = 0;
  EXPECT_TRUE(FiguresOf({expired, Of("robot1", "follow hall", State::kUnderWay),
                         Of("robot1", "follow attic", State::kRefused)},
                        {}, kLengths_m, FiguresBy::kRobot)
                  .empty());
  EXPECT_EQ(FiguresTable({}, FiguresBy::kWeek), "no missions have ended\n");
}

TEST(HistoryFigures, WhoeverStoodInTheMiddleOfAMissionByAPersonsWordNeededOne) {
  using mission::NowOrder;
  const std::vector<mission::GivenCommand> commands{
      Given(NowOrder::kPause, "robot1", kMonday_ms + 1000),
      Given(NowOrder::kResume, "robot1", kMonday_ms + 2000),
      Given(NowOrder::kStop, "robot1", kMonday_ms + 3000, /*refused=*/true),
      Given(NowOrder::kStop, "robot2", kMonday_ms + 4000),
      Given(NowOrder::kCancel, "robot1", kMonday_ms + 90'000)};
  const auto figures = FiguresOf({Of("robot1", "follow hall", State::kArrived)}, commands,
                                 kLengths_m, FiguresBy::kRobot);
  EXPECT_EQ(figures.at("robot1").interventions, 1U);
}

TEST(HistoryFigures, OfMissionsThatWaitedOnlyTheOneThatWasDoneNeededAPerson) {
  mission::Record next = Of("robot1", "follow hall", State::kArrived);
  next.changed_unix_ms += 60'000;
  const auto figures = FiguresOf({next, Of("robot1", "follow yard 0..4", State::kArrived)},
                                 {Given(mission::NowOrder::kPause, "robot1", kMonday_ms + 1000)},
                                 kLengths_m, FiguresBy::kRoute);
  EXPECT_EQ(figures.at("yard").interventions, 1U);
  EXPECT_EQ(figures.at("hall").interventions, 0U);
}

TEST(HistoryFigures, ByRouteOnlyItsOwnMetresAndByWeekThoseThatWereSentInIt) {
  const std::vector<mission::Record> missions{
      Of("robot1", "follow hall follow yard 0..4", State::kArrived),
      Of("robot2", "follow yard 0..4", State::kArrived, 0, kMonday_ms + kWeek_ms)};
  const auto routes = FiguresOf(missions, {}, kLengths_m, FiguresBy::kRoute);
  EXPECT_DOUBLE_EQ(routes.at("hall").metres, 20.0);
  EXPECT_DOUBLE_EQ(routes.at("yard").metres, 8.0);
  EXPECT_EQ(routes.at("yard").missions, 2U);
  const auto weeks = FiguresOf(missions, {}, kLengths_m, FiguresBy::kWeek);
  EXPECT_DOUBLE_EQ(weeks.at("2023-W47").metres, 24.0);
  EXPECT_DOUBLE_EQ(weeks.at("2023-W48").metres, 4.0);
}

TEST(HistoryFigures, AreLinesForSpreadsheetsAndObjectsForPrograms) {
  const std::map<std::string, HistoryFigures> figures{
      {"robot1", {.missions = 3, .arrived = 2, .metres = 1234.0, .interventions = 2}},
      {"robot2", {.missions = 1, .arrived = 1, .metres = 10.0, .interventions = 0}}};
  EXPECT_EQ(
      FiguresCsv(figures, FiguresBy::kRobot),
      "robot,missions,arrived,share_arrived,kilometres,interventions,metres_per_intervention\n"
      "robot1,3,2,0.6667,1.234,2,617.0\n"
      "robot2,1,1,1.0000,0.010,0,\n");
  const auto json = FiguresJson(figures);
  EXPECT_EQ(json[0]["name"], "robot1");
  EXPECT_EQ(json[0]["metres_per_intervention"], 617.0);
  EXPECT_TRUE(json[1]["metres_per_intervention"].is_null()) << "nobody had to see to it";
  EXPECT_THAT(FiguresTable(figures, FiguresBy::kRobot), testing::HasSubstr("67 %"));
  EXPECT_FALSE(ReadFiguresBy("month"));
  EXPECT_EQ(ReadFiguresBy("week"), FiguresBy::kWeek);
}

}  // namespace
}  // namespace trailcast::fleet
