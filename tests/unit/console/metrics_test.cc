// These test what Prometheus is told, and what is made of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "route_server/status/metrics.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "services/program/presence.h"
#include "tests/support/await.h"
#include "tests/support/places.h"

namespace trailcast::console {
namespace {

using testing::HasSubstr;
using testing::Not;

exchange::AgentStatus Robot(const std::string& name) {
  exchange::AgentStatus status;
  status.agent = AgentId(name);
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kReplaying;
  status.route = "hall";
  status.place = {{RouteId(std::string(32, 'a')), TeachingId(1)}, 3.5, 0.01, 0.02};
  status.battery_percent = 62;
  status.link_percent = 71;
  status.software = "0.1 \"beta\"";
  return status;
}

class FleetMetricsTest : public testing::Test {
 protected:
  void Hear(const exchange::Message& message) { state_.Handle(message, now_, 1500); }
  std::string Text() {
    state_.Tick(now_);
    http::MetricsText text;
    state_.Measure(text);
    return text.text();
  }

  FleetState state_{AgentId("desk")};
  FleetState::Time now_{std::chrono::seconds(100)};
};

TEST_F(FleetMetricsTest, TellsOfEachRobotWhatIsKnown) {
  Hear(Robot("robot1"));
  exchange::AgentStatus other;
  other.agent = AgentId("robot2");
  other.role = exchange::AgentRole::kScout;
  other.hold = exchange::AgentHold::kStopped;
  Hear(other);
  exchange::AgentStatus server;
  server.agent = AgentId("server");
  server.role = exchange::AgentRole::kServer;
  Hear(server);
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("\ntrailcast_robots{state=\"driving\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("\ntrailcast_robots{state=\"stopped\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("\ntrailcast_robots{state=\"offline\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_robot_info{robot=\"robot1\",role=\"follower\",software=\""
                              "0.1 \\\"beta\\\"\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_robot_state{robot=\"robot2\",state=\"stopped\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("_last_heard_timestamp_seconds{robot=\"robot1\"} 1.5\n"));
  EXPECT_THAT(text, HasSubstr("_along_route_meters{robot=\"robot1\",route=\"hall\"} 3.5\n"));
  EXPECT_THAT(text, HasSubstr("_beside_route_sigma_meters{robot=\"robot1\"} 0.02\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_robot_battery_ratio{robot=\"robot1\"} 0.62\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_robot_link_ratio{robot=\"robot1\"} 0.71\n"));
  EXPECT_THAT(text, Not(HasSubstr("battery_ratio{robot=\"robot2\"}"))) << "it does not tell";
  EXPECT_THAT(text, Not(HasSubstr("{robot=\"server\"")));
  EXPECT_THAT(text, HasSubstr("trailcast_server_heard{server=\"server\"} 1\n"));
  now_ += std::chrono::seconds(60);
  EXPECT_THAT(Text(), HasSubstr("trailcast_robot_state{robot=\"robot1\",state=\"offline\"} 1\n"));
  EXPECT_THAT(Text(), HasSubstr("trailcast_server_heard{server=\"server\"} 0\n"));
}

TEST_F(FleetMetricsTest, CountsEachMissionOnceWhereverItComesTo) {
  const auto report = [](const std::string& id, std::uint32_t change, mission::State state) {
    return mission::Report{
        .agent = AgentId("robot1"), .mission = id, .change = change, .state = state};
  };
  state_.Sent({.agent = AgentId("robot1"), .id = "trip"}, 500);
  Hear(report("trip", 1, mission::State::kUnderWay));
  Hear(report("trip", 1, mission::State::kUnderWay));
  EXPECT_THAT(Text(), HasSubstr("trailcast_missions_open{state=\"under way\"} 1\n"));
  Hear(report("trip", 3, mission::State::kFailed));
  Hear(report("trip", 2, mission::State::kPaused));
  exchange::MissionReply kept;
  kept.client = AgentId("desk");
  kept.missions.push_back({.mission = {.agent = AgentId("robot1"), .id = "trip"},
                           .last = report("trip", 3, mission::State::kFailed)});
  kept.missions.push_back({.mission = {.agent = AgentId("robot1"), .id = "of-yesterday"},
                           .last = report("of-yesterday", 3, mission::State::kFailed)});
  Hear(kept);
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("trailcast_missions_total{state=\"sent\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_missions_total{state=\"under way\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_missions_total{state=\"paused\"} 0\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_missions_total{state=\"failed\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("trailcast_missions_open{state=\"under way\"} 0\n"));
}

TEST_F(FleetMetricsTest, StrangersNamesMakeNoMoreSeriesThanThereMayBeRobots) {
  for (std::size_t i = 0; i < 2 * FleetState::kMostAgents; ++i) {
    Hear(Robot("robot" + std::to_string(i)));
  }
  const std::string text = Text();
  const std::string name = "\ntrailcast_robot_battery_ratio{";
  std::size_t series = 0;
  for (auto at = text.find(name); at != text.npos; at = text.find(name, at + 1)) ++series;
  EXPECT_EQ(series, FleetState::kMostAgents);
}

class MetricsPageTest : public testing::Test {
 protected:
  std::string Page() {
    httplib::Client client("localhost", web_->port());
    client.set_read_timeout(test::kLongEnough);
    const auto got = client.Get("/metrics");
    if (!got) return "";
    EXPECT_EQ(got->status, 200);
    EXPECT_EQ(got->get_header_value("Content-Type"), http::MetricsText::kType);
    return got->body;
  }

  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = std::chrono::milliseconds(200),
                           .reply_within = std::chrono::milliseconds(200)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}).value();
};

// The names of all samples; of each a counter is called one.
std::set<std::string> NamesIn(const std::string& text) {
  std::set<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('#')) {
      names.insert(line.substr(0, line.find_first_of("{ ")));
      continue;
    }
    std::istringstream words(line);
    std::string hash;
    std::string type;
    std::string name;
    std::string is;
    words >> hash >> type >> name >> is;
    if (type != "TYPE") continue;
    EXPECT_EQ(name.ends_with("_total"), is == "counter") << line;
  }
  return names;
}

std::string Read(const std::string& file) {
  std::ifstream in(SourceDir() + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(MetricsPageTest, HasAllThatDashboardAndAlertsName) {
  const auto peer = bus_.Open(program::WithAgents(exchange::FollowerTopics()));
  const auto serving = bus_.Open(program::WithAgents(exchange::ServerTopics()));
  exchange::AgentStatus of_serving;
  of_serving.agent = AgentId("server");
  of_serving.role = exchange::AgentRole::kServer;
  ASSERT_TRUE(serving->Publish(of_serving));
  std::string page;
  const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
  while (page.find("robot1") == page.npos && std::chrono::steady_clock::now() < until) {
    ASSERT_TRUE(peer->Publish(Robot("robot1")));
    page = Page();
  }
  server::Metrics of_server;
  of_server.queries["name"].Note(0.001);
  std::set<std::string> there = NamesIn(page);
  there.merge(NamesIn(of_server.Text()));
  for (const char* file :
       {"config/grafana/trailcast.json", "config/prometheus/trailcast-alerts.yml"}) {
    const std::string text = Read(file);
    const std::regex name("trailcast_[a-z_]+");
    std::size_t named = 0;
    for (std::sregex_iterator each(text.begin(), text.end(), name), end; each != end; ++each) {
      EXPECT_THAT(there, testing::Contains(each->str())) << file;
      ++named;
    }
    EXPECT_GT(named, 5U) << file;
  }
}

TEST_F(MetricsPageTest, CountsCommandsAndPages) {
  httplib::Client client("localhost", web_->port());
  client.set_read_timeout(test::kLongEnough);
  (void)client.Post("/api/robots/robot1/stop", "{}", "application/json");
  EXPECT_THAT(Page(),
              HasSubstr("trailcast_commands_total{order=\"stop\",result=\"unanswered\"} 1\n"));
  EXPECT_THAT(Page(), HasSubstr("trailcast_console_streams 0\n"));
  std::string within;
  (void)client.Get("/api/events", [&](const char*, std::size_t) {
    within = Page();
    return false;
  });
  EXPECT_THAT(within, HasSubstr("trailcast_console_streams 1\n"));
}

TEST(Dashboard, IsOneThatGrafanaReads) {
  const auto board = nlohmann::json::parse(Read("config/grafana/trailcast.json"));
  EXPECT_GE(board["schemaVersion"], 36) << "Grafana 9";
  std::set<int> ids;
  for (const auto& panel : board["panels"]) {
    EXPECT_TRUE(ids.insert(panel["id"].get<int>()).second) << panel["title"];
    EXPECT_LE(panel["gridPos"]["x"].get<int>() + panel["gridPos"]["w"].get<int>(), 24);
    for (const auto& target : panel.value("targets", nlohmann::json::array())) {
      EXPECT_FALSE(target["expr"].get<std::string>().empty()) << panel["title"];
    }
  }
}

}  // namespace
}  // namespace trailcast::console
