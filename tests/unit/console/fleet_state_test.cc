#include "services/console/fleet_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::console {
namespace {

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
    return json::parse(state_.Json());
  }
  json Robot(const std::string& name = "robot1") {
    const json shown = Shown();
    for (const json& robot : shown["robots"]) {
      if (robot["name"] == name) return robot;
    }
    return json();
  }
  std::string StateOf(AgentMode mode, const std::string& detail) {
    Hear(Status("robot1", mode, detail));
    return Robot()["state"];
  }

  FleetState state_{AgentId("desk")};
  FleetState::Time now_{seconds(100)};
};

TEST_F(FleetStateTest, SaysInAWordHowARobotIsAndWhichOrdersWouldChangeThat) {
  EXPECT_EQ(StateOf(AgentMode::kReplaying, ""), "driving");
  EXPECT_EQ(Robot()["orders"], json({"pause", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kWaiting, "free; mission a: arrived"), "free");
  EXPECT_EQ(StateOf(AgentMode::kWaiting, "paused by desk: rain"), "paused");
  EXPECT_EQ(Robot()["orders"], json({"resume", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kWaiting, "released, and stands until it is told to resume"),
            "paused");
  EXPECT_EQ(StateOf(AgentMode::kWaiting, "stopped by desk on 2026-11-24 at 05:30:12 UTC"),
            "stopped");
  EXPECT_EQ(Robot()["orders"], json({"release", "stop"}));
  EXPECT_EQ(StateOf(AgentMode::kWaiting, "waits for robot2"), "waiting");
  EXPECT_EQ(StateOf(AgentMode::kStopped, "stopped by a signal"), "ended");
  EXPECT_EQ(Robot()["orders"], json::array());
  EXPECT_EQ(StateOf(AgentMode::kFault, "LOST"), "fault");
  EXPECT_EQ(Robot()["needs_person"], true);
}

TEST_F(FleetStateTest, WhoIsSilentOrGoneStaysListed) {
  Hear(Status("robot1", AgentMode::kReplaying));
  Hear(Status("robot2", AgentMode::kReplaying));
  EXPECT_EQ(Robot()["last_heard_unix_ms"], nullptr);
  Hear(exchange::AgentGone{AgentId("robot1"), 6});
  EXPECT_EQ(Robot()["heard"], true) << "that was another process";
  Hear(exchange::AgentGone{AgentId("robot1"), 7});
  EXPECT_EQ(Robot()["state"], "silent");
  EXPECT_EQ(Robot()["last_heard_unix_ms"], 1000);
  EXPECT_EQ(Robot("robot2")["heard"], true);
  now_ += seconds(10);
  EXPECT_EQ(Robot("robot2")["state"], "silent");
  Hear(Status("robot1", AgentMode::kReplaying));
  EXPECT_EQ(Robot()["state"], "driving");
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
  EXPECT_TRUE(state_.lacks_orders());
  EXPECT_EQ(Robot()["mission"]["orders"], "");
  Hear(Kept(Report("trip", 2, State::kFetching), 500));
  EXPECT_FALSE(state_.lacks_orders());
  EXPECT_EQ(Robot()["mission"]["state"], "under way") << "the newer";
  EXPECT_EQ(Robot()["mission"]["orders"], "follow hall");
  EXPECT_EQ(Robot()["orders"], json({"pause", "cancel", "stop"}));
  Hear(Report("trip", 4, State::kFailed, "LOST"));
  EXPECT_EQ(Robot()["mission"], nullptr);
  EXPECT_EQ(Robot()["needs_person"], true);
  EXPECT_EQ(Shown()["missions"][0]["detail"], "LOST");
  Hear(Kept(Report("next", 1, State::kAccepted), 600));
  EXPECT_EQ(Robot()["needs_person"], false);
  EXPECT_EQ(Shown()["missions"][0]["mission"], "next") << "the newest first";
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

TEST_F(FleetStateTest, ShowsRoutesAndHowFarARobotIsAlongItsOwn) {
  exchange::CatalogReply reply;
  reply.server = AgentId("server");
  reply.client = AgentId("desk");
  route::RouteInfo hall;
  hall.key = {RouteId(std::string(32, 'a')), TeachingId(1)};
  hall.name = "hall";
  hall.length_m = 12.345;
  hall.standing = route::Standing::kActive;
  reply.page.routes = {hall};
  Hear(reply);
  AgentStatus status = Status("robot1", AgentMode::kReplaying);
  status.place = {hall.key, 3.001};
  Hear(status);
  EXPECT_EQ(Shown()["routes"][0]["name"], "hall");
  EXPECT_EQ(Robot()["along_m"], 3.0);
  EXPECT_EQ(Robot()["length_m"], 12.35);
  reply.page.routes.clear();
  reply.client = AgentId("somebody");
  Hear(reply);
  EXPECT_EQ(Shown()["routes"].size(), 1U) << "that was no answer to this one";
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
