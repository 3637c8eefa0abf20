#include "services/console/fleet_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace trailcast::console {
namespace {

using exchange::AgentHold;
using exchange::AgentMode;
using exchange::AgentRole;
using exchange::AgentStatus;
using mission::State;
using nlohmann::json;
using std::chrono::seconds;

class FleetStateTest : public testing::Test {
 protected:
  static AgentStatus Status(const std::string& name, AgentMode mode, const std::string& detail = "",
                            AgentRole role = AgentRole::kFollower) {
    AgentStatus status;
    status.agent = AgentId(name);
    status.instance = 7;
    status.role = role;
    status.mode = mode;
    status.detail = detail;
    return status;
  }
  static mission::Report Report(const std::string& id, std::uint32_t change, State state,
                                const std::string& detail = "") {
    return {.agent = AgentId("robot1"),
            .mission = id,
            .change = change,
            .state = state,
            .detail = detail};
  }
  static exchange::MissionReply Kept(const mission::Report& last, std::int64_t sent_unix_ms) {
    exchange::MissionReply reply;
    reply.client = AgentId("desk");
    reply.missions.push_back({.mission = {.agent = last.agent,
                                          .id = last.mission,
                                          .client = AgentId("other"),
                                          .orders = "follow hall"},
                              .last = last,
                              .sent_unix_ms = sent_unix_ms});
    return reply;
  }
  void Hear(const exchange::Message& message) { state_.Handle(message, now_, 1000); }
  json Shown() {
    state_.Tick(now_);
    return json::parse(StateBody(state_.Shown(), 0));
  }
  json Robot(const std::string& name = "robot1") {
    const json shown = Shown();
    for (const json& robot : shown["robots"]) {
      if (robot["name"] == name) return robot;
    }
    return json();
  }
  std::string StateOf(AgentMode mode, AgentHold hold = AgentHold::kNone, bool on_duty = false) {
    AgentStatus status = Status("robot1", mode);
    status.hold = hold;
    status.on_duty = on_duty;
    Hear(status);
    return Robot()["state"];
  }

  FleetState state_{AgentId("desk")};
  FleetState::Time now_{seconds(100)};
};

TEST_F(FleetStateTest, ARobotsQueueIsShownInOrderWithWhatEachWaitsFor) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Kept(Report("m1", 2, State::kUnderWay), 500));
  Hear(Kept(Report("m3", 0, State::kSent, "waits: mission m2 comes before"), 900));
  Hear(Kept(Report("m2", 0, State::kSent, "waits: it does mission m1"), 700));
  EXPECT_EQ(Robot()["mission"]["mission"], "m1");
  ASSERT_EQ(Robot()["queue"].size(), 2U);
  EXPECT_EQ(Robot()["queue"][0]["mission"], "m2");
  EXPECT_EQ(Robot()["queue"][0]["detail"], "waits: it does mission m1");
  EXPECT_EQ(Robot()["queue"][1]["mission"], "m3");
  Hear(Report("m2", 0, State::kSent, "waits: stopped by desk"));
  EXPECT_EQ(Robot()["queue"][0]["detail"], "waits: stopped by desk");
  Hear(Report("m2", 1, State::kAccepted));
  ASSERT_EQ(Robot()["queue"].size(), 1U);
}

TEST_F(FleetStateTest, AQueueThatIsHeldWhileItsRobotHasNoMissionMayBeResumedOrCancelled) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Kept(Report("m1", 2, State::kUnderWay), 500));
  auto held = Report("m2", 0, State::kSent, "waits: it does mission m1");
  held.waits_for = mission::WaitsFor::kTurn;
  Hear(Kept(held, 700));
  EXPECT_EQ(Robot()["orders"], json({"pause", "cancel", "stop"}));
  Hear(Status("robot1", AgentMode::kWaiting));
  Hear(Report("m1", 3, State::kFailed));
  held.detail = "waits: mission m1 did not arrive (failed): resume the robot to go on, or cancel";
  Hear(held);
  EXPECT_EQ(Robot()["orders"], json({"pause", "resume", "cancel", "stop"}));
  held.detail.clear();
  held.waits_for = mission::WaitsFor::kNothing;
  Hear(held);
  EXPECT_EQ(Robot()["orders"], json({"pause", "cancel", "stop"})) << "it is being handed over";
}

TEST_F(FleetStateTest, SaysInAWordHowARobotIsAndWhichOrdersWouldChangeThat) {
  EXPECT_EQ(StateOf(AgentMode::kReplaying), "driving");
  EXPECT_EQ(Robot()["orders"], json({"pause", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kNone, true), "available");
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kPaused), "paused");
  EXPECT_EQ(Robot()["orders"], json({"resume", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kReplaying, AgentHold::kStopped), "driving") << "yet";
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kStopped, true), "stopped");
  EXPECT_EQ(Robot()["orders"], json({"release", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kWaiting), "waiting");
  EXPECT_EQ(StateOf(AgentMode::kStopped, AgentHold::kStopped), "shut down");
  EXPECT_EQ(Robot()["orders"], json::array());
  EXPECT_EQ(StateOf(AgentMode::kTeaching, AgentHold::kNone, true), "teaching");
  EXPECT_EQ(Robot()["orders"], json({"pause", "end", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kTeaching, AgentHold::kPaused, true), "paused");
  EXPECT_EQ(Robot()["teaches"], true);
  EXPECT_TRUE(state_.Teaches(AgentId("robot1")));
  EXPECT_FALSE(state_.Teaches(AgentId("robot7")));
  EXPECT_EQ(StateOf(AgentMode::kFault), "fault");
  EXPECT_EQ(Robot()["needs_person"], true);
}

TEST_F(FleetStateTest, WhoIsOnDutyIsFreeOnlyWithoutAMission) {
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kNone, true), "available");
  Hear(Report("trip", 1, State::kUnderWay));
  EXPECT_EQ(Robot()["state"], "waiting");
  Hear(Report("trip", 2, State::kArrived));
  EXPECT_EQ(Robot()["state"], "available");
}

TEST_F(FleetStateTest, WhoIsHeldInTheMiddleOfAMissionNeedsAPerson) {
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kPaused, true), "paused");
  EXPECT_EQ(Robot()["needs_person"], false) << "it has nothing to do";
  Hear(Report("trip", 1, State::kPaused, "its agent has started again"));
  EXPECT_EQ(Robot()["needs_person"], true) << "it does not go on by itself";
  EXPECT_EQ(StateOf(AgentMode::kReplaying), "driving");
  EXPECT_EQ(Robot()["needs_person"], false);
}

TEST_F(FleetStateTest, ShowsHowTheRobotIsItselfWhereItTells) {
  AgentStatus status = Status("robot1", AgentMode::kWaiting);
  Hear(status);
  EXPECT_EQ(Robot()["battery_percent"], nullptr);
  EXPECT_EQ(Robot()["link_percent"], nullptr);
  EXPECT_EQ(Robot()["left_sigma_m"], nullptr);
  EXPECT_EQ(Robot()["follows_by"], "");
  status.battery_percent = 12;
  status.link_percent = 71;
  status.software = "0.1.0";
  status.place = {{RouteId(std::string(32, 'a')), TeachingId(1)}, 3.0, -0.118, 0.031};
  Hear(status);
  EXPECT_EQ(Robot()["battery_percent"], 12);
  EXPECT_EQ(Robot()["link_percent"], 71);
  EXPECT_EQ(Robot()["software"], "0.1.0");
  EXPECT_EQ(Robot()["left_m"], -0.12);
  EXPECT_EQ(Robot()["left_sigma_m"], 0.03);
  status.following =
      exchange::Following{exchange::CarriedBy::kFeatures, exchange::OdometryTrust{90, 0.5}};
  status.place->left_sigma_m = 0.003;
  Hear(status);
  EXPECT_EQ(Robot()["left_sigma_m"], 0.01);
  EXPECT_EQ(Robot()["follows_by"],
            "Odometry: counts 2.00 times too much for this route, corrected");
}

TEST_F(FleetStateTest, WhereARobotStoodLastIsKeptUntilItSaysAnew) {
  AgentStatus status = Status("robot1", AgentMode::kReplaying);
  Hear(status);
  EXPECT_EQ(Robot()["stood"], nullptr);
  status.route = "hall";
  status.place = {{RouteId(std::string(32, 'a')), TeachingId(26)}, 3.125};
  Hear(status);
  EXPECT_EQ(Robot()["stood"], nullptr) << "it says where it is";
  Hear(Status("robot1", AgentMode::kWaiting));
  EXPECT_EQ(Robot()["along_m"], nullptr);
  EXPECT_EQ(Robot()["stood"]["route"], "hall");
  EXPECT_EQ(Robot()["stood"]["route_id"], std::string(32, 'a'));
  EXPECT_EQ(Robot()["stood"]["teaching"], "1a");
  EXPECT_EQ(Robot()["stood"]["along_m"], 3.13);
}

TEST_F(FleetStateTest, WhoIsSilentOrGoneStaysListed) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Status("robot2", AgentMode::kReplaying));
  EXPECT_EQ(Robot()["last_heard_unix_ms"], nullptr);
  Hear(exchange::AgentGone{AgentId("robot1"), 6});
  EXPECT_EQ(Robot()["heard"], true) << "that was another process";
  Hear(exchange::AgentGone{AgentId("robot1"), 7});
  EXPECT_EQ(Robot()["state"], "offline");
  EXPECT_EQ(Robot()["last_heard_unix_ms"], 1000);
  EXPECT_EQ(Robot("robot2")["heard"], true);
  now_ += seconds(10);
  EXPECT_EQ(Robot("robot2")["state"], "offline");
  Hear(Status("robot1", AgentMode::kReplaying));
  EXPECT_EQ(Robot()["state"], "driving");
}

TEST_F(FleetStateTest, AMissionOfAGroupIsTheRobotsOnceItIsGivenToOne) {
  mission::Report waits = Report("trip", 0, State::kSent, "waits: no robot of @cart is free");
  waits.agent = AgentId("@cart");
  Hear(waits);
  Hear(Kept(waits, 1000));
  EXPECT_EQ(Shown()["missions"][0]["robot"], "@cart");
  Hear(Report("trip", 0, State::kSent));
  ASSERT_EQ(Shown()["missions"].size(), 1U) << Shown().dump(2);
  EXPECT_EQ(Shown()["missions"][0]["robot"], "robot1");
  Hear(waits);
  Hear(Kept(waits, 1000));
  EXPECT_EQ(Shown()["missions"].size(), 1U) << "that was on its way for longer\n"
                                            << Shown().dump(2);
}

TEST_F(FleetStateTest, WhoStoodFreeAndIsLongGoneIsListedNoMore) {
  AgentStatus driving = Status("robot1", AgentMode::kReplaying);
  driving.speed_mps = 0.4;
  Hear(driving);
  Hear(Status("robot2", AgentMode::kWaiting));
  Hear(Report("trip", 1, State::kUnderWay));
  AgentStatus on_mission = Status("robot3", AgentMode::kWaiting);
  Hear(on_mission);
  mission::Report waits = Report("later", 1, State::kUnderWay);
  waits.agent = AgentId("robot3");
  Hear(waits);
  now_ += FleetState::kGoneAfter - seconds(1);
  EXPECT_EQ(Robot("robot2")["state"], "offline");
  now_ += seconds(1);
  EXPECT_EQ(Robot("robot2"), json());
  EXPECT_EQ(Robot()["state"], "offline") << "it may be moving";
  EXPECT_EQ(Robot("robot3")["state"], "offline") << "somebody waits for it";
  EXPECT_EQ(state_.MayMove(now_).size(), 2U);
}

TEST_F(FleetStateTest, APersonDismissesWhoIsNotHeardAndNobodyElse) {
  Hear(Status("robot1", AgentMode::kReplaying));
  EXPECT_EQ(state_.Forget(AgentId("robot2"), now_).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(state_.Forget(AgentId("robot1"), now_).error().code, ErrorCode::kConflict) << "heard";
  now_ += seconds(10);
  state_.KeepTelling(AgentId("robot1"), {.client = AgentId("desk")}, now_, 1234);
  EXPECT_EQ(state_.Forget(AgentId("robot1"), now_).error().code, ErrorCode::kConflict)
      << "it has not answered a stop";
  state_.Release(AgentId("robot1"), now_);
  EXPECT_TRUE(state_.Forget(AgentId("robot1"), now_));
  EXPECT_EQ(Robot(), json());
  Hear(Status("robot1", AgentMode::kReplaying));
  EXPECT_EQ(Robot()["state"], "driving") << "it is back";
}

TEST_F(FleetStateTest, WhoHasNotEndedMayMoveHoweverLongItIsSilent) {
  AgentStatus status = Status("robot1", AgentMode::kReplaying);
  status.speed_mps = 0.4;
  Hear(status);
  Hear(Status("robot2", AgentMode::kStopped));
  Hear(Status("scout", AgentMode::kTeaching, "", AgentRole::kScout));
  Hear(exchange::AgentGone{AgentId("robot1"), 7});
  const auto known = state_.MayMove(now_ + seconds(5));
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known[0].robot, AgentId("robot1"));
  EXPECT_EQ(known[0].last_seen, "last seen 5 s ago, moving at 0.40 m/s");
}

TEST_F(FleetStateTest, AnUnansweredStopIsToldAgainUntilItIsAnsweredOrHoldsOrIsWithdrawn) {
  const exchange::NowCommand stop{.client = AgentId("desk"), .number = 9, .reason = "rain"};
  const auto open = [&] {
    AgentStatus moving = Status("robot1", AgentMode::kReplaying);
    Hear(moving);
    state_.KeepTelling(AgentId("robot1"), stop, now_, 1234);
    EXPECT_EQ(Robot()["unanswered_stop_unix_ms"], 1234);
    EXPECT_EQ(Robot()["needs_person"], true);
    now_ += FleetState::kStopAgainEvery;
    Hear(moving);
    const auto told = state_.TakeOpenStops(now_);
    ASSERT_EQ(told.size(), 1U) << "it moves yet";
    EXPECT_EQ(told[0].number, 9U) << "obeyed once, however often it is heard";
    EXPECT_EQ(told[0].reason, "rain");
    EXPECT_EQ(told[0].whom, mission::NowWhom::kRobot) << "others have answered";
    EXPECT_EQ(told[0].name, "robot1");
    EXPECT_TRUE(state_.TakeOpenStops(now_).empty()) << "just told";
  };
  const auto is_over = [&] {
    now_ += FleetState::kStopAgainEvery;
    return Robot()["unanswered_stop_unix_ms"].is_null() && state_.TakeOpenStops(now_).empty();
  };
  open();
  Hear(exchange::NowAnswer{AgentId("robot1"), AgentId("desk"), 8});
  EXPECT_EQ(Robot()["unanswered_stop_unix_ms"], 1234) << "that was to something else";
  Hear(exchange::NowAnswer{AgentId("robot1"), AgentId("desk"), 9});
  EXPECT_TRUE(is_over()) << "answered";
  open();
  AgentStatus stopped = Status("robot1", AgentMode::kWaiting);
  stopped.hold = AgentHold::kStopped;
  Hear(stopped);
  EXPECT_TRUE(is_over()) << "it stands by somebody else's stop";
  open();
  Hear(Status("robot1", AgentMode::kStopped));
  EXPECT_TRUE(is_over()) << "it has ended";
  open();
  now_ += seconds(10);
  EXPECT_EQ(Robot()["orders"], json({"release", "stop"})) << "offline";
  const auto told_at = now_;
  now_ += seconds(1);
  state_.Release(AgentId("robot1"), now_);
  EXPECT_TRUE(is_over()) << "withdrawn";
  state_.KeepTelling(AgentId("robot1"), stop, told_at, 1234);
  EXPECT_TRUE(is_over()) << "the release was the later word";
  state_.KeepTelling(AgentId("nobody"), stop, now_, 1234);
  EXPECT_TRUE(state_.TakeOpenStops(now_).empty());
}

TEST_F(FleetStateTest, NothingChangesWhileARobotSaysTheSame) {
  Hear(Status("robot1", AgentMode::kReplaying));
  const json before = Shown();
  now_ += seconds(1);
  state_.Handle(Status("robot1", AgentMode::kReplaying), now_, 2000);
  EXPECT_EQ(Shown(), before);
}

TEST_F(FleetStateTest, AMissionIsWhatTheRobotSaidLastWithOrdersFromWhoKnowsThem) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Report("trip", 3, State::kUnderWay));
  EXPECT_EQ(Robot()["mission"]["orders"], "");
  state_.AskedForMissions(0);
  EXPECT_TRUE(state_.lacks_missions());
  Hear(Kept(Report("trip", 2, State::kFetching), 500));
  EXPECT_FALSE(state_.lacks_missions());
  EXPECT_EQ(Robot()["mission"]["state"], "under way") << "the newer";
  EXPECT_EQ(Robot()["mission"]["orders"], "follow hall");
  EXPECT_EQ(Robot()["orders"], json({"pause", "cancel", "stop"}));
  Hear(Report("trip", 4, State::kFailed, "LOST"));
  EXPECT_EQ(Robot()["mission"], nullptr);
  EXPECT_EQ(Robot()["needs_person"], true);
  EXPECT_EQ(StateOf(AgentMode::kWaiting, AgentHold::kNone, true), "failed") << "and not available";
  EXPECT_EQ(Shown()["missions"][0]["detail"], "LOST");
  Hear(Kept(Report("next", 1, State::kAccepted), 600));
  EXPECT_EQ(Robot()["needs_person"], false);
  EXPECT_EQ(Shown()["missions"][0]["mission"], "next") << "the newest first";
}

TEST_F(FleetStateTest, ThatThereAreNoMissionsIsKnownOnlyFromAServer) {
  EXPECT_EQ(Shown()["missions"], nullptr);
  state_.AskedForMissions(17);
  exchange::MissionReply reply{.client = AgentId("desk"), .request = 16};
  Hear(reply);
  EXPECT_EQ(Shown()["missions"], nullptr) << "of another question";
  reply.request = 17;
  reply.error = "its disk is full";
  Hear(reply);
  EXPECT_TRUE(state_.lacks_missions());
  EXPECT_EQ(Shown()["missions"], nullptr);
  reply.error.clear();
  Hear(reply);
  EXPECT_FALSE(state_.lacks_missions());
  EXPECT_EQ(Shown()["missions"], json::array());
}

TEST_F(FleetStateTest, WhatAServerPutsOffOrDoesNotTellIsNothingNew) {
  state_.AskedForMissions(17);
  Hear(exchange::MissionReply{.client = AgentId("desk"), .request = 17});
  Hear(Report("of-another", 0, State::kPutOff, "over quota"));
  EXPECT_FALSE(state_.lacks_missions());
  EXPECT_EQ(Shown()["missions"], json::array());
  Hear(Report("trip", 3, State::kUnderWay));
  Hear(exchange::MissionReply{.client = AgentId("desk"), .request = 17, .error = "over quota"});
  EXPECT_TRUE(state_.lacks_missions()) << "nobody has told its orders";
}

TEST_F(FleetStateTest, SilentInTheMiddleOfAMissionNeedsAPerson) {
  Hear(Status("robot1", AgentMode::kReplaying));
  state_.Sent({.agent = AgentId("robot1"), .id = "trip", .orders = "follow hall"}, 500);
  EXPECT_EQ(Robot()["mission"], nullptr) << "it has not answered";
  Hear(Report("trip", 1, State::kUnderWay));
  EXPECT_EQ(Robot()["mission"]["orders"], "follow hall");
  now_ += seconds(10);
  EXPECT_EQ(Robot()["needs_person"], true);
}

TEST_F(FleetStateTest, ShowsTheRoutesThatRobotsAreOnAndHowFarEachIs) {
  exchange::CatalogReply reply;
  reply.server = AgentId("server");
  reply.client = AgentId("desk");
  route::RouteInfo hall;
  hall.key = {RouteId(std::string(32, 'a')), TeachingId(1)};
  hall.name = "hall";
  hall.length_m = 12.345;
  hall.state = route::RouteState::kComplete;
  hall.standing = route::Standing::kActive;
  route::RouteInfo other = hall;
  other.key.teaching = TeachingId(2);
  reply.page.routes = {hall, other};
  Hear(reply);
  EXPECT_EQ(Shown()["routes"], json::array()) << "nobody is on them";
  EXPECT_TRUE(state_.TakeLackingRoutes(now_).empty());

  AgentStatus status = Status("robot1", AgentMode::kReplaying);
  status.place = {hall.key, 3.001};
  Hear(status);
  EXPECT_EQ(Robot()["along_m"], 3.0);
  EXPECT_EQ(Robot()["length_m"], nullptr);
  EXPECT_EQ(state_.TakeLackingRoutes(now_), std::vector{hall.key.route});
  EXPECT_TRUE(state_.TakeLackingRoutes(now_).empty()) << "it was asked for just now";
  EXPECT_FALSE(state_.TakeLackingRoutes(now_ + seconds(10)).empty());

  exchange::CatalogReply stranger = reply;
  stranger.client = AgentId("somebody");
  Hear(stranger);
  EXPECT_EQ(Shown()["routes"], json::array()) << "that was no answer to this one";
  Hear(reply);
  ASSERT_EQ(Shown()["routes"].size(), 1U);
  EXPECT_EQ(Shown()["routes"][0]["name"], "hall");
  EXPECT_EQ(Shown()["routes"][0]["teaching"], "1");
  EXPECT_EQ(Robot()["length_m"], 12.35);
  EXPECT_TRUE(state_.TakeLackingRoutes(now_ + seconds(60)).empty());
  status.place.reset();
  Hear(status);
  EXPECT_EQ(Shown()["routes"], json::array());
}

TEST_F(FleetStateTest, AChangeIsWhatIsOtherThanBefore) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Status("robot2", AgentMode::kReplaying));
  state_.Tick(now_);
  const auto before = state_.Shown();
  EXPECT_EQ(json::parse(ChangeBody(before, before, 5)),
            json({{"now_unix_ms", 5}, {"robots", json::array()}, {"gone", json::array()}}));
  AgentStatus paused = Status("robot2", AgentMode::kWaiting);
  paused.hold = AgentHold::kPaused;
  Hear(paused);
  Hear(Report("trip", 1, State::kPaused));
  state_.Tick(now_);
  const json change = json::parse(ChangeBody(before, state_.Shown(), 5));
  ASSERT_EQ(change["robots"].size(), 2U) << change;
  EXPECT_EQ(change["robots"][0]["mission"]["mission"], "trip");
  EXPECT_EQ(change["robots"][1]["name"], "robot2");
  EXPECT_EQ(change["robots"][1]["state"], "paused");
  EXPECT_FALSE(change["robots"][1].contains("role")) << "of a robot what is other, too";
  const auto nobody = FleetState(AgentId("desk")).Shown();
  const json whole = json::parse(ChangeBody(nobody, before, 5));
  EXPECT_EQ(whole["robots"], json::parse(StateBody(before, 5))["robots"]) << "of new ones all";
  EXPECT_EQ(change["missions"].size(), 1U);
  EXPECT_FALSE(change.contains("servers"));
  EXPECT_EQ(json::parse(ChangeBody(before, nobody, 5))["gone"], json({"robot1", "robot2"}));
}

TEST_F(FleetStateTest, TellsWhatSomebodyHasToSeeToWhereAndWhy) {
  Alerts alerts;
  const auto to_see_to = [&] {
    state_.Tick(now_);
    const auto [causes, subjects, unsure] = state_.WhatToSeeTo(alerts);
    alerts.Note(causes, subjects, unsure, 1000);
    std::vector<std::string> kinds;
    for (const Cause& cause : causes) kinds.push_back(cause.subject + " " + cause.kind);
    std::sort(kinds.begin(), kinds.end());
    return kinds;
  };
  AgentStatus status = Status("robot1", AgentMode::kReplaying);
  status.route = "hall";
  status.place = {{RouteId(std::string(32, 'a')), TeachingId(0x1a)}, 7.12};
  status.battery_percent = 30;
  Hear(status);
  Hear(Status("server", AgentMode::kWaiting, "", AgentRole::kServer));
  Hear(Report("trip", 1, State::kUnderWay));
  EXPECT_THAT(to_see_to(), testing::IsEmpty());
  Hear(Status("robot2", AgentMode::kWaiting));
  EXPECT_EQ(state_.WhatToSeeTo(alerts).unsure, std::set<std::string>{"robot2"});
  state_.AskedForMissions(17);
  Hear(exchange::MissionReply{.client = AgentId("desk"), .request = 17});
  EXPECT_EQ(state_.WhatToSeeTo(alerts).unsure, std::set<std::string>{}) << "it had none";

  status.mode = AgentMode::kWaiting;
  status.hold = AgentHold::kPaused;
  status.detail = "paused by anna";
  Hear(status);
  ASSERT_THAT(to_see_to(), testing::ElementsAre("robot1 held"));
  const Cause held = state_.WhatToSeeTo(alerts).causes.front();
  EXPECT_FALSE(held.alarm);
  EXPECT_EQ(held.place, "7.1 m of hall");
  EXPECT_THAT(held.reason, testing::HasSubstr("paused by anna"));

  status.hold = AgentHold::kNone;
  status.mode = AgentMode::kReplaying;
  Hear(status);
  EXPECT_THAT(to_see_to(), testing::IsEmpty()) << "it drives on";
  now_ += seconds(10);
  EXPECT_THAT(to_see_to(), testing::ElementsAre("robot1 offline", "server server-offline"));
  Hear(status);
  Hear(Status("server", AgentMode::kWaiting, "", AgentRole::kServer));
  Hear(Report("trip", 2, State::kFailed, "LOST"));
  ASSERT_THAT(to_see_to(), testing::ElementsAre("robot1 failed"));
  EXPECT_THAT(state_.WhatToSeeTo(alerts).causes.front().reason, testing::HasSubstr("LOST"));

  status.battery_percent = 19;
  Hear(status);
  EXPECT_THAT(to_see_to(), testing::ElementsAre("robot1 battery", "robot1 failed"));
  status.battery_percent = 21;
  Hear(status);
  EXPECT_THAT(to_see_to(), testing::ElementsAre("robot1 battery", "robot1 failed"))
      << "hardly charged";
  status.battery_percent = 25;
  Hear(status);
  EXPECT_THAT(to_see_to(), testing::ElementsAre("robot1 failed"));
  state_.KeepTelling(AgentId("robot1"), {.client = AgentId("desk")}, now_, 1234);
  EXPECT_THAT(to_see_to(), testing::ElementsAre("robot1 failed", "robot1 not-stopped"));
}

TEST_F(FleetStateTest, StrangersNamesDoNotFillTheMemory) {
  for (std::size_t i = 0; i < 2 * FleetState::kMostAgents; ++i) {
    Hear(Status("robot" + std::to_string(i), AgentMode::kReplaying));
    Hear(Report("mission" + std::to_string(i), 1, State::kAccepted));
  }
  EXPECT_EQ(Shown()["robots"].size(), FleetState::kMostAgents);
  EXPECT_EQ(Shown()["missions"].size(), FleetState::kMissionsShown);
}

}  // namespace
}  // namespace trailcast::console
