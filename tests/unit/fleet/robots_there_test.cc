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
  EXPECT_EQ(robots.size(), 1U) << "that was another process";
  robots.Hear(exchange::AgentGone{AgentId("robot1"), 7});
  EXPECT_EQ(robots.size(), 0U);
  for (std::size_t i = 0; i < 2 * RobotsThere::kMost; ++i) {
    robots.Hear(RobotStatus("robot" + std::to_string(i)));
  }
  EXPECT_EQ(robots.size(), RobotsThere::kMost);
}

}  // namespace
}  // namespace trailcast::fleet
