#include "services/fleet/robots_there.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace trailcast::fleet {
namespace {

using testing::HasSubstr;
using testing::Not;

exchange::AgentStatus RobotStatus(const std::string& name) {
  exchange::AgentStatus status;
  status.agent = AgentId(name);
  status.instance = 7;
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kWaiting;
  return status;
}

TEST(RobotsThere, AreToldWithWhatTheySayOfThemselves) {
  RobotsThere robots;
  EXPECT_EQ(robots.Text(), "");
  EXPECT_EQ(robots.Json().dump(), "[]");
  exchange::AgentStatus status = RobotStatus("robot1");
  status.hold = exchange::AgentHold::kPaused;
  status.route = "hall";
  status.detail = "paused by desk: \"rain\"";
  status.place = {{RouteId(std::string(32, 'a')), TeachingId(1)}, 3.5, 0.012, 0.031};
  status.battery_percent = 62;
  status.software = "0.1.0";
  status.following = exchange::Following{exchange::CarriedBy::kViews, std::nullopt};
  robots.Hear(status);
  robots.Hear(RobotStatus("robot2"));
  EXPECT_THAT(robots.Text(), HasSubstr("robot1           paused    hall"));
  EXPECT_THAT(robots.Text(), HasSubstr("±3 cm"));
  EXPECT_THAT(robots.Text(), HasSubstr("62 %"));
  EXPECT_THAT(robots.Text(), HasSubstr("paused by desk: \"rain\"; Follows by its camera alone\n"));
  EXPECT_THAT(robots.Text(), HasSubstr("robot2           waiting   -"));
  const auto json = robots.Json();
  EXPECT_EQ(json[0]["hold"], "paused");
  EXPECT_EQ(json[0]["place"]["along_m"], 3.5);
  EXPECT_EQ(json[0]["place"]["left_m"], 0.012);
  EXPECT_EQ(json[0]["battery_percent"], 62);
  EXPECT_EQ(json[0]["link_percent"], nullptr);
  EXPECT_EQ(json[0]["detail"], "paused by desk: \"rain\"");
  EXPECT_EQ(json[0]["follows_by"], "Follows by its camera alone");
  EXPECT_EQ(json[1]["robot"], "robot2");
  EXPECT_EQ(json[1]["follows_by"], "");
  EXPECT_EQ(json[1]["mode"], "waiting");
}

TEST(RobotsThere, AreNeitherServersNorGoneNorWithoutEnd) {
  RobotsThere robots;
  exchange::AgentStatus server = RobotStatus("server");
  server.role = exchange::AgentRole::kServer;
  robots.Hear(server);
  robots.Hear(RobotStatus("robot1"));
  EXPECT_THAT(robots.Text(), Not(HasSubstr("server")));
  robots.Hear(exchange::AgentGone{AgentId("robot1"), 6});
  EXPECT_TRUE(robots.any_heard()) << "that was another process";
  robots.Hear(exchange::AgentGone{AgentId("robot1"), 7});
  EXPECT_FALSE(robots.any_heard());
  EXPECT_THAT(robots.Text(), HasSubstr("robot1           offline"));
  for (std::size_t i = 0; i < 2 * RobotsThere::kMost; ++i) {
    robots.Hear(RobotStatus("robot" + std::to_string(i)));
  }
  EXPECT_EQ(robots.size(), RobotsThere::kMost);
}

TEST(RobotsThere, AreAsTheConsoleSaysAlsoWhereOnlyAServerKnowsThem) {
  RobotsThere robots;
  exchange::AgentStatus status = RobotStatus("robot1");
  status.on_duty = true;
  robots.Hear(status);
  EXPECT_EQ(robots.Json()[0]["state"], "available");
  exchange::MissionReply reply;
  const auto add = [&](const char* robot, std::uint32_t change, mission::State state,
                       std::int64_t sent_unix_ms) {
    reply.missions.push_back({.mission = {.agent = AgentId(robot), .orders = "follow hall"},
                              .last = {.agent = AgentId(robot), .change = change, .state = state},
                              .sent_unix_ms = sent_unix_ms});
  };
  add("robot1", 0, mission::State::kSent, 40);
  add("robot1", 2, mission::State::kRefused, 30);
  add("robot1", 5, mission::State::kFailed, 20);
  add("robot1", 4, mission::State::kUnderWay, 10);
  add("robot2", 3, mission::State::kUnderWay, 10);
  add("robot3", 3, mission::State::kArrived, 10);
  robots.Hear(reply);
  ASSERT_EQ(robots.size(), 2U) << "robot3 may have been gone for years";
  EXPECT_EQ(robots.Json()[0]["state"], "failed") << "the newest that it has taken";
  EXPECT_EQ(robots.Json()[1]["state"], "offline");
  EXPECT_EQ(robots.Json()[1]["heard"], false);
  EXPECT_THAT(robots.Text(), HasSubstr("last known on its mission 'follow hall', under way"));
  RobotsThere only_by_a_server;
  only_by_a_server.Hear(reply);
  EXPECT_FALSE(only_by_a_server.any_heard());
}

}  // namespace
}  // namespace trailcast::fleet
