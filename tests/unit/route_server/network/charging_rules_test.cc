#include "route_server/network/charging_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr network::ChargeLimits kLimits{20, 90};
const AgentId kRobot{"robot1"};
const AgentId kOther{"robot2"};

RobotSeen At(std::optional<std::uint8_t> battery_percent) {
  return {.agent = kRobot, .battery_percent = battery_percent};
}

TEST(ChargingRules, ARobotIsToChargeBelowTheLimitOnceAndOnlyIfItTellsItsBattery) {
  EXPECT_TRUE(IsToCharge(At(19), kLimits));
  EXPECT_FALSE(IsToCharge(At(20), kLimits));
  EXPECT_FALSE(IsToCharge(At({}), kLimits));
  RobotSeen sent = At(5);
  sent.is_sent = true;
  EXPECT_FALSE(IsToCharge(sent, kLimits));
  RobotSeen docked = At(5);
  docked.dock = "dock1";
  EXPECT_FALSE(IsToCharge(docked, kLimits)) << "it charges";
  docked.may_go_on = true;
  EXPECT_TRUE(IsToCharge(docked, kLimits)) << "it did, and does no more";
}

TEST(ChargingRules, ItChargesUntilItIsFullEnoughAndMayGoOnThen) {
  RobotSeen docked = At(43);
  EXPECT_EQ(Charges(docked, kLimits), "") << "nowhere";
  docked.dock = "dock1";
  EXPECT_EQ(Charges(docked, kLimits),
            "charges at dock1: its battery is at 43 %, and it goes on at 90 %, or when it is told "
            "to resume");
  docked.battery_percent.reset();
  EXPECT_THAT(Charges(docked, kLimits), HasSubstr("it does not tell its battery"));
  EXPECT_FALSE(IsFull(docked, kLimits));
  docked.battery_percent = 89;
  EXPECT_NE(Charges(docked, kLimits), "");
  docked.battery_percent = 90;
  EXPECT_EQ(Charges(docked, kLimits), "");
  EXPECT_TRUE(IsFull(docked, kLimits));
  docked.battery_percent = 89;
  docked.may_go_on = true;
  EXPECT_EQ(Charges(docked, kLimits), "") << "it was full, or an operator wants it";
}

std::set<AgentId> Now(const std::set<AgentId>& before, const Sighting& seen) {
  return HoldersNow(before, std::vector{seen});
}

TEST(ChargingRules, ARobotHasADockUntilItIsKnownToBeElsewhere) {
  Sighting seen{.agent = kRobot, .is_heard = true, .is_placed = true};
  seen.goes_there = true;
  EXPECT_THAT(Now({}, seen), ElementsAre(kRobot));
  seen.goes_there = false;
  EXPECT_THAT(Now({kRobot}, seen), IsEmpty());
  seen.is_there = true;
  EXPECT_THAT(Now({kOther}, seen), ElementsAre(kRobot, kOther));
  seen.is_heard = false;
  EXPECT_THAT(Now({kRobot}, seen), ElementsAre(kRobot)) << "silent, it stands there";
  EXPECT_THAT(Now({}, seen), IsEmpty()) << "somebody has looked";
  seen.is_there = seen.is_placed = false;
  EXPECT_THAT(Now({kRobot}, seen), ElementsAre(kRobot)) << "after a restart";
  EXPECT_THAT(HoldersNow({kRobot}, {}), ElementsAre(kRobot));
}

TEST(ChargingRules, TheNearestFreeDockIsChosen) {
  const std::vector<DockSeen> docks{{.name = "a", .holders = {kOther}, .length_m = 1.0},
                                    {.name = "b", .length_m = 9.0},
                                    {.name = "c", .holders = {kRobot}, .length_m = 5.0},
                                    {.name = "d", .no_way = "all is closed"}};
  EXPECT_EQ(ChooseDock(kRobot, docks).name, "c");
  EXPECT_EQ(ChooseDock(AgentId("robot3"), docks).name, "b");
}

TEST(ChargingRules, WithoutAFreeDockItSaysWhyThereIsNone) {
  EXPECT_THAT(ChooseDock(kRobot, {}).why_none, HasSubstr("no place is a dock"));
  const std::vector<DockSeen> docks{
      {.name = "a", .holders = {kOther, AgentId("robot3")}, .length_m = 1.0},
      {.name = "d", .no_way = "all is closed"}};
  const DockChoice choice = ChooseDock(kRobot, docks);
  EXPECT_EQ(choice.name, "");
  EXPECT_EQ(choice.why_none,
            "no dock is free: a is taken by robot2 and robot3, d is not reached: all is closed");
}

}  // namespace
}  // namespace trailcast::server
