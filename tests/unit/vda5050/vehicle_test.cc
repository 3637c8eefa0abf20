#include "services/vda5050/vehicle.h"

#include <chrono>

#include "services/program/json.h"
#include "tests/unit/vda5050/master.h"

namespace trailcast::vda5050 {
namespace {

using exchange::AgentMode;
using exchange::NowOrder;
using mission::State;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const AgentId kRobot("robot1");
const AgentId kSelf("vda5050-1");

// There are an available robot and a fleet manager. Whatever the robot tells is held against the
// schema.
class VehicleTest : public testing::TestWithParam<Version> {
 protected:
  VehicleTest() {
    graph_ = Graph::Read({"route hall 10", "route office 6", "route attic 3",
                          "join hall@4.5 office@0.5", "name dock office@5"})
                 .value();
    status_ = {.agent = kRobot,
               .instance = 1,
               .role = exchange::AgentRole::kFollower,
               .mode = AgentMode::kWaiting,
               .on_duty = true,
               .battery_percent = 80};
    Hear(status_);
  }
  bool is_new() const { return GetParam() == Version::k3_0; }
  void Hear(const exchange::Message& message) {
    vehicle_.Hear(message, now_);
    vehicle_.Tick(&*graph_, now_);
    Note(vehicle_.Due(now_));
  }
  void Wait(milliseconds time) {
    now_ += time;
    Hear(status_);
  }
  void Note(const std::vector<exchange::Message>& messages) {
    for (const exchange::Message& message : messages) {
      if (const auto* mission = std::get_if<mission::Mission>(&message)) mission_ = *mission;
      if (const auto* command = std::get_if<exchange::NowCommand>(&message)) {
        command_ = *command;
        ++commands_;
      }
    }
  }
  void Tick() {
    vehicle_.Tick(&*graph_, now_);
    Note(vehicle_.Due(now_));
  }
  void Order(const json& order) {
    if (HasSchemas()) {
      EXPECT_THAT(Violations(GetParam(), "order", order.dump()), IsEmpty());
    }
    vehicle_.TakeOrder(order.dump(), &*graph_, now_);
    Tick();
  }
  void Act(const std::string& type, const std::string& id, const std::string& order = "") {
    vehicle_.TakeInstantActions(master_.Actions(type, id, order).dump(), now_);
    Tick();
  }
  // The robot says that of the mission that it was sent last.
  void Report(State state, const std::string& detail = "", std::uint32_t task = 0,
              mission::WaitsFor waits_for = mission::WaitsFor::kNothing) {
    ASSERT_TRUE(mission_);
    Hear(mission::Report{.agent = kRobot,
                         .mission = mission_->id,
                         .change = ++change_,
                         .state = state,
                         .task = task,
                         .waits_for = waits_for,
                         .detail = detail});
  }
  void Stand(const std::string& route, double along_m, double speed_mps = 0.0) {
    status_.route = route;
    status_.place = exchange::PlaceOnRoute{.along_m = along_m};
    status_.speed_mps = speed_mps;
    status_.mode = speed_mps == 0.0 ? AgentMode::kWaiting : AgentMode::kReplaying;
    Hear(status_);
  }
  void Answer(bool refused, const std::string& detail) {
    ASSERT_TRUE(command_);
    Hear(exchange::NowAnswer{.agent = kRobot,
                             .client = kSelf,
                             .number = command_->number,
                             .refused = refused,
                             .detail = detail});
  }
  json StateNow() {
    program::Json state = Header(vehicle_.identity(), 1, 0);
    state.update(vehicle_.State(now_));
    const std::string text = program::OneLine(state);
    if (HasSchemas()) {
      EXPECT_THAT(Violations(GetParam(), "state", text), IsEmpty()) << text;
    }
    return json::parse(text);
  }
  std::vector<std::string> Errors() {
    std::vector<std::string> types;
    const json state = StateNow();
    for (const json& error : state.at("errors")) types.push_back(error.at("errorType"));
    return types;
  }
  std::string Description(const std::string& type) {
    const json state = StateNow();
    for (const json& error : state.at("errors")) {
      if (error.at("errorType") == type) return error.at("errorDescription");
    }
    return "";
  }
  std::vector<std::string> NodesLeft() {
    std::vector<std::string> nodes;
    const json state = StateNow();
    for (const json& node : state.at("nodeStates")) nodes.push_back(node.at("nodeId"));
    EXPECT_EQ(state.at("edgeStates").size(), nodes.size());
    return nodes;
  }
  std::string ActionStatus(const std::string& id) {
    const json state = StateNow();
    for (const json& each : state.at(is_new() ? "instantActionStates" : "actionStates")) {
      if (each.at("actionId") == id) return each.at("actionStatus");
    }
    return "none";
  }

  Vehicle::Time now_{std::chrono::hours(1)};
  Vehicle vehicle_{{GetParam(), "acme", "robot1"}, kSelf, std::nullopt};
  Master master_{vehicle_.identity()};
  std::optional<Graph> graph_;
  exchange::AgentStatus status_;
  std::optional<mission::Mission> mission_;
  std::optional<exchange::NowCommand> command_;
  int commands_ = 0;
  std::uint32_t change_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Both, VehicleTest, testing::Values(Version::k2_1, Version::k3_0),
                         [](const auto& each) {
                           return std::string(each.param == Version::k3_0 ? "of30" : "of21");
                         });

TEST_P(VehicleTest, WhatIsToldIsHeldAgainstTheStandardsSchemas) {
  if (!HasSchemas()) GTEST_SKIP() << "../shared/conformance/vda5050 is absent";
  const json state = StateNow();
  EXPECT_EQ(state.at("orderId"), "");
  EXPECT_EQ(state.at("operatingMode"), "AUTOMATIC");
  EXPECT_EQ(state.at(is_new() ? "powerSupply" : "batteryState")
                .at(is_new() ? "stateOfCharge" : "batteryCharge"),
            80);
  EXPECT_FALSE(state.contains(is_new() ? "mobileRobotPosition" : "agvPosition"));
}

TEST_P(VehicleTest, ThatItChargesIsToldAtOnceInAServersWordsAndElseVouchedFor) {
  const auto charging = [&] {
    return StateNow().at(is_new() ? "powerSupply" : "batteryState").at("charging").get<bool>();
  };
  const char* const text = is_new() ? "infoDescriptor" : "infoDescription";
  const auto before = program::OneLine(vehicle_.Events(now_));
  EXPECT_FALSE(charging());
  EXPECT_THAT(StateNow().at("information")[0].at(text), HasSubstr("charging"));
  vehicle_.NoteCharging("charges at dock1: its battery is at 17 %");
  EXPECT_TRUE(charging());
  EXPECT_NE(program::OneLine(vehicle_.Events(now_)), before);
  const json information = StateNow().at("information");
  ASSERT_EQ(information.size(), 2U);
  EXPECT_THAT(information[0].at(text), Not(HasSubstr("charging"))) << "nobody vouches for that";
  EXPECT_EQ(information[1].at(text), "charges at dock1: its battery is at 17 %");
  vehicle_.NoteCharging("");
  EXPECT_FALSE(charging());
}

TEST_P(VehicleTest, AnOrderAlongARouteIsFollowedToItsEnd) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:4.5", "hall:10"}, 3));
  EXPECT_THAT(Errors(), IsEmpty());
  ASSERT_TRUE(mission_);
  EXPECT_EQ(mission_->orders, "goto hall@10 follow hall 0..10");
  EXPECT_EQ(mission_->agent, kRobot);
  EXPECT_EQ(mission_->client, kSelf);
  EXPECT_EQ(mission_->valid_for_s, Vehicle::kValidFor_s) << "no server keeps it for long";
  EXPECT_EQ(StateNow().at("lastNodeId"), "hall:0");
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:4.5", "hall:10"));

  Report(State::kUnderWay);
  Stand("hall", 3.0, 0.4);
  json state = StateNow();
  EXPECT_EQ(state.at("driving"), true);
  EXPECT_EQ(state.at("lastNodeId"), "hall:0");
  EXPECT_NEAR(state.at("distanceSinceLastNode").get<double>(), 3.0, 0.01);
  Stand("hall", 6.0, 0.4);
  state = StateNow();
  EXPECT_EQ(state.at("lastNodeId"), "hall:4.5");
  EXPECT_EQ(state.at("lastNodeSequenceId"), 2);
  EXPECT_NEAR(state.at("distanceSinceLastNode").get<double>(), 1.5, 0.01);
  Stand("hall", 10.0, 0.1);
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:10")) << "it has not arrived yet";
  Report(State::kArrived);
  Stand("hall", 10.0);
  EXPECT_THAT(NodesLeft(), IsEmpty());
  EXPECT_EQ(StateNow().at("lastNodeId"), "hall:10");
  EXPECT_EQ(StateNow().at("orderId"), "o1") << "kept until the next";
}

TEST_P(VehicleTest, ANamedPlaceIsReachedOverAJunction) {
  Stand("hall", 1.2);
  EXPECT_EQ(StateNow().at("lastNodeId"), "") << "no node is there";
  Order(master_.Order("o1", 0, {"hall:1.5", "office:2", "dock"}, 3));
  ASSERT_TRUE(mission_) << StateNow();
  EXPECT_EQ(mission_->orders, "goto dock follow hall 1.2..4.5 follow office 0.5..5");
  Report(State::kUnderWay);
  Stand("office", 2.5, 0.4);
  EXPECT_EQ(StateNow().at("lastNodeId"), "office:2");
  Report(State::kArrived);
  EXPECT_EQ(StateNow().at("lastNodeId"), "dock");
}

TEST_P(VehicleTest, TheHorizonWaitsForAnUpdateThatStitchesOn) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:2", "hall:4"}, 2));
  ASSERT_TRUE(mission_);
  EXPECT_EQ(mission_->orders, "goto hall@2 follow hall 0..2") << "what is released, no more";
  EXPECT_EQ(StateNow().at("newBaseRequest"), true);
  Report(State::kArrived);
  Stand("hall", 2.0);
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:4")) << "it waits";
  const std::string first = mission_->id;
  Wait(seconds(1));
  EXPECT_EQ(mission_->id, first) << "nothing more is released";

  Order(master_.Order("o1", 1, {"hall:0", "hall:2"}, 2));
  EXPECT_THAT(Errors(), ElementsAre("VALIDATION_FAILURE"));
  EXPECT_THAT(Description("VALIDATION_FAILURE"), HasSubstr("last released node, 'hall:2'"));
  Order(master_.Order("o1", 1, {"hall:2", "hall:3", "hall:6"}, 2, 2));
  EXPECT_THAT(Errors(), IsEmpty());
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:3", "hall:6")) << "the horizon is the new one";
  EXPECT_NE(mission_->id, first);
  EXPECT_EQ(mission_->orders, "goto hall@3 follow hall 2..3");
  // Released while it is on its way: stitched on when it arrives.
  Report(State::kUnderWay);
  Order(master_.Order("o1", 2, {"hall:3", "hall:6"}, 2, 4));
  EXPECT_EQ(mission_->orders, "goto hall@3 follow hall 2..3");
  Stand("hall", 3.0);
  Report(State::kArrived);
  EXPECT_EQ(mission_->orders, "goto hall@6 follow hall 3..6");
  EXPECT_EQ(StateNow().at("orderUpdateId"), 2);
}

TEST_P(VehicleTest, OrdersThatCannotBeTakenAreRejectedAndTheOldOneGoesOn) {
  const auto refused = [&](const json& order) {
    Order(order);
    const auto errors = Errors();
    return errors.empty() ? "" : errors.front();
  };
  EXPECT_EQ(refused(master_.Order("x", 0, {"hall:0", "bay"}, 2)), "NO_ROUTE_TO_TARGET");
  EXPECT_THAT(Description("NO_ROUTE_TO_TARGET"), HasSubstr("no node 'bay'"));
  EXPECT_EQ(refused(master_.Order("x", 0, {"attic:0", "hall:3"}, 2)), "NO_ROUTE_TO_TARGET");
  EXPECT_EQ(refused(master_.Order("x", 0, {"hall:0", "hall:3", "hall:1"}, 1)), "NO_ROUTE_TO_TARGET")
      << "of the horizon, too";
  json action = master_.Order("x", 0, {"hall:0", "hall:3"}, 2);
  action["nodes"][1]["actions"].push_back(
      {{"actionType", "pick"}, {"actionId", "p"}, {"blockingType", "HARD"}});
  EXPECT_EQ(refused(action), "INVALID_ORDER_ACTION");
  if (is_new()) {
    EXPECT_EQ(refused(master_.Order("x", 3, {"hall:0", "hall:3"}, 2)), "VALIDATION_FAILURE");
  }
  vehicle_.TakeOrder(master_.Order("x", 0, {"hall:0"}, 1).dump(), nullptr, now_);
  EXPECT_THAT(Description("NO_ROUTE_TO_TARGET"), HasSubstr("no route server has told"));
  Stand("hall", 7.0);
  EXPECT_EQ(refused(master_.Order("x", 0, {"hall:3", "hall:8"}, 2)), "START_NODE_OUT_OF_RANGE");
  EXPECT_THAT(Description("START_NODE_OUT_OF_RANGE"), HasSubstr("7.0 m along hall"));
  EXPECT_FALSE(mission_) << "nothing of that was driven";
  EXPECT_EQ(StateNow().at("orderId"), "");

  Order(master_.Order("o1", 2 * !is_new(), {"hall:7", "hall:9"}, 2));
  EXPECT_THAT(Errors(), IsEmpty()) << "an order was taken";
  const std::string sent = mission_->id;
  Order(master_.Order("o1", 2 * !is_new(), {"hall:7", "hall:9"}, 2));
  EXPECT_THAT(Errors(), IsEmpty()) << "said again";
  EXPECT_EQ(refused(master_.Order("o1", 2 * !is_new(), {"hall:7", "hall:8"}, 2)),
            "SAME_ORDER_UPDATE_ID");
  EXPECT_EQ(refused(master_.Order("o2", 0, {"hall:7", "hall:8"}, 2)), "OTHER_ORDER_ACTIVE");
  Order(master_.Order("o1", 5, {"hall:9", "hall:10"}, 2, 2));
  EXPECT_EQ(refused(master_.Order("o1", 4, {"hall:9", "hall:10"}, 2, 2)), "OUTDATED_ORDER_UPDATE");
  EXPECT_EQ(mission_->id, sent) << "it goes on";
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:9", "hall:10"));
}

TEST_P(VehicleTest, ARobotThatCannotTakeOrdersSaysWhyUntilItCan) {
  const json order = master_.Order("o1", 0, {"hall:0", "hall:3"}, 2);
  const auto refused = [&](const char* words) {
    Order(order);
    EXPECT_THAT(Description("MOBILE_ROBOT_NOT_AVAILABLE"), HasSubstr(words));
    EXPECT_FALSE(mission_);
  };
  status_.on_duty = false;
  Hear(status_);
  EXPECT_EQ(StateNow().at("operatingMode"), "MANUAL");
  refused("it is not on duty");
  status_.on_duty = true;
  Hear(status_);
  EXPECT_THAT(Errors(), IsEmpty()) << "it can now";
  status_.mode = AgentMode::kTeaching;
  Hear(status_);
  EXPECT_EQ(StateNow().at("operatingMode"), is_new() ? "TEACH_IN" : "TEACHIN");
  refused("takes no orders now");
  status_.mode = AgentMode::kFault;
  status_.detail = "no camera";
  Hear(status_);
  refused("no camera");
  EXPECT_THAT(Errors(), Contains("ROBOT_FAULT"));
  status_.mode = AgentMode::kWaiting;
  Hear(status_);
  Hear(mission::Report{.agent = kRobot, .mission = "m7", .change = 3, .state = State::kUnderWay});
  refused("does mission m7 of another sender");
  Hear(mission::Report{.agent = kRobot, .mission = "m7", .change = 4, .state = State::kArrived});
  EXPECT_THAT(Errors(), IsEmpty());
  now_ += Vehicle::kSilentAfter + seconds(1);
  refused("robot1 is not heard");
  EXPECT_EQ(vehicle_.ConnectionAt(now_), Connection::kBroken);
  Hear(status_);
  EXPECT_EQ(vehicle_.ConnectionAt(now_), Connection::kOnline);
  Hear(exchange::AgentGone{.agent = kRobot, .instance = 1});
  EXPECT_EQ(vehicle_.ConnectionAt(now_), Connection::kBroken);
  status_.mode = AgentMode::kStopped;
  Hear(status_);
  EXPECT_EQ(vehicle_.ConnectionAt(now_), Connection::kOffline);
}

TEST_P(VehicleTest, AMissionThatDoesNotArriveIsAnErrorAndTheOrderStays) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:3", "hall:6"}, 2));
  Report(State::kUnderWay);
  Report(State::kFailed, "nothing of segment 3 is seen", 0, mission::WaitsFor::kPlace);
  EXPECT_THAT(Errors(), ElementsAre("LOCALIZATION_ERROR", "NODE_UNREACHABLE"));
  EXPECT_THAT(Description("LOCALIZATION_ERROR"), HasSubstr("nothing of segment 3 is seen"));
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:3", "hall:6"));
  const std::string failed = mission_->id;
  Order(master_.Order("o1", 1, {"hall:3", "hall:6"}, 2, 2));
  Wait(seconds(1));
  EXPECT_EQ(mission_->id, failed) << "an update does not send it on";
  Act("cancelOrder", "c1");
  EXPECT_EQ(ActionStatus("c1"), "FINISHED") << "nothing of it is on its way";
  EXPECT_EQ(commands_, 0);
  EXPECT_THAT(Errors(), ElementsAre("LOCALIZATION_ERROR"));
  Order(master_.Order("o2", 0, {"hall:3", "hall:6"}, 2));
  Report(State::kUnderWay);
  EXPECT_THAT(Errors(), ElementsAre("LOCALIZATION_ERROR")) << "it has not said where it is";
  Stand("hall", 3.1, 0.3);
  EXPECT_THAT(Errors(), IsEmpty());
  Report(State::kCancelled, "cancelled by operator");
  EXPECT_THAT(Description("NODE_UNREACHABLE"), HasSubstr("cancelled: cancelled by operator"));
}

TEST_P(VehicleTest, WhetherARobotIsLostIsNotDecidedByItsWords) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:3"}, 2));
  Report(State::kFailed, "LOST: xyzzy");
  EXPECT_THAT(Errors(), ElementsAre("NODE_UNREACHABLE"));
  Act("cancelOrder", "c1");
  for (const char* words : {"xyzzy", ""}) {
    Order(master_.Order(fmt::format("o-{}", words), 0, {"hall:0", "hall:3"}, 2));
    Report(State::kFailed, words, 0, mission::WaitsFor::kPlace);
    EXPECT_THAT(Errors(), ElementsAre("LOCALIZATION_ERROR", "NODE_UNREACHABLE")) << words;
    Act("cancelOrder", fmt::format("c-{}", words));
  }
}

TEST_P(VehicleTest, ARobotThatDoesNotAnswerIsToldOf) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:3"}, 2));
  EXPECT_THAT(Errors(), IsEmpty());
  Wait(seconds(6));
  EXPECT_THAT(Errors(), ElementsAre("ROBOT_DOES_NOT_ANSWER"));
  Report(State::kUnderWay);
  EXPECT_THAT(Errors(), IsEmpty());
}

TEST_P(VehicleTest, CancelOrderEndsTheMissionOnceTheRobotObeys) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:9"}, 2));
  Report(State::kUnderWay);
  Stand("hall", 3.0, 0.4);
  Act("cancelOrder", "c0", "other");
  EXPECT_EQ(ActionStatus("c0"), "FAILED");
  EXPECT_THAT(Errors(), ElementsAre("NO_ORDER_TO_CANCEL"));
  EXPECT_EQ(commands_, 0);
  Act("cancelOrder", "c1", "o1");
  ASSERT_EQ(commands_, 1);
  EXPECT_EQ(command_->order, NowOrder::kCancel);
  EXPECT_EQ(command_->name, "robot1");
  EXPECT_EQ(command_->whom, exchange::NowWhom::kRobot);
  EXPECT_EQ(ActionStatus("c1"), "RUNNING");
  Act("cancelOrder", "c1", "o1");
  Wait(milliseconds(100));
  EXPECT_EQ(commands_, 2) << "told again, not twice";
  Answer(false, "mission cancelled");
  EXPECT_EQ(ActionStatus("c1"), "RUNNING") << "it does not stand yet";
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:9"));
  Report(State::kCancelled, "cancelled by an operator");
  Stand("hall", 3.2);
  EXPECT_EQ(ActionStatus("c1"), "FINISHED");
  EXPECT_THAT(NodesLeft(), IsEmpty());
  EXPECT_THAT(Errors(), ElementsAre("NO_ORDER_TO_CANCEL")) << "until an order is taken";
  EXPECT_EQ(StateNow().at("orderId"), "o1");
  Order(master_.Order("o1", 1, {"hall:9", "hall:10"}, 2, 2));
  EXPECT_THAT(Errors(), Contains("ORDER_UPDATE_FOLLOWING_CANCEL"));
  Act("cancelOrder", "c2");
  EXPECT_EQ(ActionStatus("c2"), "FAILED") << "there is none";
}

TEST_P(VehicleTest, AMissionThatReachesTheRobotAfterItsCancelIsCancelledThere) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:9"}, 2));
  ASSERT_TRUE(mission_);
  Act("cancelOrder", "c1");
  Answer(true, "has no mission to cancel");
  EXPECT_EQ(ActionStatus("c1"), "RUNNING") << "a server may have it in a queue";
  Wait(seconds(2));
  EXPECT_EQ(ActionStatus("c1"), "FINISHED");
  EXPECT_THAT(NodesLeft(), IsEmpty());
  const int told = commands_;
  Report(State::kUnderWay);
  EXPECT_EQ(commands_, told + 1);
  EXPECT_EQ(command_->order, NowOrder::kCancel);
}

TEST_P(VehicleTest, WhatTheRobotDoesNotObeyIsAnError) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:9"}, 2));
  Report(State::kUnderWay);
  Stand("hall", 3.0, 0.4);
  Act("cancelOrder", "c1");
  Answer(true, "it is changing routes");
  Wait(seconds(2));
  EXPECT_EQ(ActionStatus("c1"), "FAILED");
  EXPECT_THAT(Errors(), ElementsAre("ROBOT_DID_NOT_OBEY"));
  EXPECT_THAT(Description("ROBOT_DID_NOT_OBEY"), HasSubstr("does not obey: it is changing routes"));
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:9")) << "the order goes on";

  Act("startPause", "p1");
  EXPECT_EQ(command_->order, NowOrder::kPause);
  const int before = commands_;
  Wait(Vehicle::kAnswerWithin + milliseconds(1));
  EXPECT_EQ(ActionStatus("p1"), "FAILED");
  EXPECT_THAT(Description("ROBOT_DID_NOT_OBEY"), HasSubstr("did not answer within 5 s and may be"));
  Wait(seconds(1));
  EXPECT_GT(commands_, before + 1) << "it is told on";
  Answer(false, "paused by vda5050");
  status_.hold = exchange::AgentHold::kPaused;
  Stand("hall", 3.5);
  EXPECT_THAT(Errors(), IsEmpty()) << "it stands";
  EXPECT_EQ(StateNow().at("paused"), true);
  EXPECT_EQ(ActionStatus("p1"), "FAILED") << "what was told stays";
}

TEST_P(VehicleTest, APauseIsOverWithStopPause) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:9"}, 2));
  Report(State::kUnderWay);
  Act("startPause", "p1");
  Answer(false, "paused");
  status_.hold = exchange::AgentHold::kPaused;
  Hear(status_);
  EXPECT_EQ(ActionStatus("p1"), "FINISHED");
  EXPECT_EQ(StateNow().at("paused"), true);
  Act("stopPause", "r1");
  EXPECT_EQ(command_->order, NowOrder::kResume);
  Answer(true, "stopped: release it first");
  EXPECT_EQ(ActionStatus("r1"), "FAILED");
  EXPECT_THAT(Errors(), ElementsAre("ROBOT_DID_NOT_OBEY"));
  Act("stopPause", "r2");
  Answer(false, "goes on");
  status_.hold = exchange::AgentHold::kNone;
  Hear(status_);
  EXPECT_EQ(ActionStatus("r2"), "FINISHED");
  EXPECT_THAT(Errors(), IsEmpty());
  Act("stopPause", "r3");
  const int told = commands_;
  Wait(Vehicle::kAnswerWithin + milliseconds(1));
  EXPECT_EQ(ActionStatus("r3"), "FAILED");
  Wait(seconds(2));
  EXPECT_LE(commands_, told + 1) << "nobody is to go on late";
}

TEST_P(VehicleTest, StateAndFactsheetAreSentWhenAsked) {
  EXPECT_FALSE(vehicle_.TakeFactsheetRequest());
  Act("factsheetRequest", "f1");
  EXPECT_TRUE(vehicle_.TakeFactsheetRequest());
  EXPECT_FALSE(vehicle_.TakeFactsheetRequest());
  EXPECT_TRUE(vehicle_.TakeStateRequest());
  Act("stateRequest", "s1");
  EXPECT_TRUE(vehicle_.TakeStateRequest());
  EXPECT_FALSE(vehicle_.TakeStateRequest());
  EXPECT_EQ(ActionStatus("f1"), "FINISHED");
  EXPECT_EQ(ActionStatus("s1"), "FINISHED");
  Act("dance", "d1");
  EXPECT_EQ(ActionStatus("d1"), "FAILED");
  EXPECT_THAT(Description("INVALID_INSTANT_ACTION"), HasSubstr("'dance' is no instant action"));
  Act("clearInstantActions", "e1");
  EXPECT_EQ(ActionStatus("e1"), is_new() ? "FINISHED" : "FAILED");
  EXPECT_EQ(ActionStatus("f1"), is_new() ? "none" : "FINISHED");
  vehicle_.TakeInstantActions("{", now_);
  EXPECT_THAT(Errors(), ElementsAre("VALIDATION_FAILURE"));
  for (int i = 0; i < 200; ++i) Act("stateRequest", std::to_string(i));
  EXPECT_LE(StateNow().at(is_new() ? "instantActionStates" : "actionStates").size(),
            kMostActionStates);
}

TEST_P(VehicleTest, ABatteryThatIsNotToldIsNotMadeUp) {
  status_.battery_percent.reset();
  Hear(status_);
  EXPECT_FALSE(vehicle_.tells_battery());
  Vehicle vouched({GetParam(), "acme", "robot1"}, kSelf, 100);
  EXPECT_TRUE(vouched.tells_battery());
}

TEST_P(VehicleTest, ATeachingEndsWhatWasOrdered) {
  Order(master_.Order("o1", 0, {"hall:0", "hall:2", "hall:4"}, 2));
  Report(State::kArrived);
  Stand("hall", 2.0);
  EXPECT_THAT(NodesLeft(), ElementsAre("hall:4"));
  status_.mode = AgentMode::kTeaching;
  Hear(status_);
  EXPECT_THAT(NodesLeft(), IsEmpty());
  EXPECT_EQ(StateNow().at("lastNodeId"), "");
}

}  // namespace
}  // namespace trailcast::vda5050
