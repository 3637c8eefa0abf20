#include "services/console/web.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "services/console/src/api/files.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "services/program/presence.h"
#include "tests/support/await.h"
#include "tests/support/described.h"
#include "tests/support/strangers/hostile_client.h"
#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;

class WebTest : public testing::Test {
 protected:
  [[nodiscard]] httplib::Client Client() const {
    httplib::Client client("localhost", web_->port());
    client.set_logger(ExpectAsDescribed());
    client.set_read_timeout(test::kLongEnough);
    return client;
  }

  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics()),
             Desk::Options{.answer_within = milliseconds(200), .reply_within = milliseconds(200)}};
  Atlas atlas_{
      [this]() -> Result<fleet::OperatorPeer> {
        return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
      },
      milliseconds(200)};
  std::unique_ptr<Web> web_ =
      Web::Open(desk_, atlas_, nullptr, "localhost", 0, {"desk.site"}).value();
};

TEST_F(WebTest, ThePageComesWithWhatKeepsOthersOut) {
  const auto page = Client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("/page.js"));
  EXPECT_THAT(page->body, HasSubstr("rel=\"modulepreload\" href=\"/code/"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
  EXPECT_EQ(page->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(page->get_header_value("X-Frame-Options"), "DENY");
  EXPECT_EQ(page->get_header_value("Referrer-Policy"), "no-referrer");
  for (const File& each : Files()) {
    const char* path = each.path;
    const auto file = Client().Get(path);
    ASSERT_TRUE(file) << path;
    EXPECT_EQ(file->status, 200) << path;
    const std::string tag = file->get_header_value("ETag");
    const auto again = Client().Get(path, {{"If-None-Match", tag}});
    ASSERT_TRUE(again) << path;
    EXPECT_EQ(again->status, 304) << path;
    EXPECT_EQ(again->body, "");
  }
  EXPECT_EQ(Client().Get("/etc/passwd")->status, 404);
}

TEST_F(WebTest, WhatIsLongComesPackedToWhoUnpacksIt) {
  for (const File& each : Files()) {
    if (each.packed.empty()) continue;
    const char* path = each.path;
    httplib::Client client = Client();
    const auto plain = client.Get(path, {{"Accept-Encoding", "identity"}});
    ASSERT_TRUE(plain) << path;
    EXPECT_FALSE(plain->has_header("Content-Encoding")) << path;
    const auto unpacked = client.Get(path, {{"Accept-Encoding", "gzip"}});
    ASSERT_TRUE(unpacked) << path;
    EXPECT_EQ(unpacked->body, plain->body) << path;
    client.set_decompress(false);
    const auto packed = client.Get(path, {{"Accept-Encoding", "gzip"}});
    ASSERT_TRUE(packed) << path;
    EXPECT_EQ(packed->get_header_value("Content-Encoding"), "gzip") << path;
    EXPECT_EQ(packed->get_header_value("Vary"), "Accept-Encoding") << path;
    EXPECT_LT(2 * packed->body.size(), plain->body.size()) << path;
  }
}

TEST_F(WebTest, AlertsAreListedAndAcknowledged) {
  const auto robot = bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.instance = 7;
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kFault;
  status.detail = "its camera is gone";
  const auto alerts = [&] {
    (void)robot->Publish(status);
    return json::parse(Client().Get("/api/alerts")->body)["alerts"];
  };
  ASSERT_TRUE(test::WaitUntil([&] { return alerts().size() == 1; }));
  EXPECT_EQ(alerts()[0]["reason"], "Fault: its camera is gone");
  EXPECT_EQ(json::parse(Client().Get("/api/alerts")->body)["kept"], false);
  ASSERT_TRUE(test::WaitUntil([&] {
    return json::parse(Client().Get("/api/state")->body)["alerts"].size() == 1;
  })) << "it is there though nobody has looked before";
  const std::string path = "/api/alerts/" + alerts()[0]["alert"].get<std::string>();
  EXPECT_EQ(Client().Post(path + "/acknowledge", "{}", "application/json")->status, 200);
  EXPECT_EQ(alerts()[0]["acknowledged_by"], "console");
  EXPECT_EQ(Client().Post("/api/alerts/none/acknowledge", "{}", "application/json")->status, 404);
  status.mode = exchange::AgentMode::kWaiting;
  EXPECT_TRUE(test::WaitUntil([&] { return !alerts()[0]["ended_unix_ms"].is_null(); }));
}

TEST_F(WebTest, RefusesOtherHostsAndOtherPages) {
  const auto get = [&](const char* host) { return Client().Get("/api/state", {{"Host", host}}); };
  EXPECT_EQ(get("evil.example")->status, 421);
  EXPECT_EQ(get("desk.site")->status, 200);
  const auto elsewhere =
      Client().Post("/api/all/stop", {{"Origin", "http://evil.example"}}, "{}", "application/json");
  EXPECT_EQ(elsewhere->status, 403);
  EXPECT_THAT(json::parse(elsewhere->body)["error"].get<std::string>(), HasSubstr("another page"));
  EXPECT_EQ(Client().Post("/api/robots/robot1/resume", "{}", "text/plain")->status, 415);
  EXPECT_EQ(Client().Post("/api/robots/robot1/resume", "{", "application/json")->status, 400);
  EXPECT_EQ(Client().Post("/api/robots/a%20b/stop", "{}", "application/json")->status, 404);
  EXPECT_EQ(Client().Post("/api/robots/robot1/stop", "{}", "application/json")->status, 504);
  EXPECT_EQ(Client()
                .Post("/api/robots/robot1/drive",
                      R"({"linear_mps":0.1,"turn_radps":0,"driver":"page","said_ms":7})",
                      "application/json")
                ->status,
            404);
  EXPECT_EQ(Client().Get("/api/missions?limit=0")->status, 400);
  EXPECT_EQ(Client().Get("/api/missions?limit=101")->status, 400);
  EXPECT_EQ(Client().Get("/api/missions?robot=a%2Fb")->status, 400);
  EXPECT_EQ(Client().Get("/api/missions")->status, 503) << "no server";
  EXPECT_EQ(Client().Get("/api/figures?group=month")->status, 400);
  EXPECT_EQ(Client().Get("/api/figures?format=xml")->status, 400);
  EXPECT_EQ(Client().Get("/api/figures?group=week")->status, 503) << "no server";
}

TEST_F(WebTest, WhatIsThereForAnotherMethodIsSaid) {
  const auto stop = Client().Get("/api/robots/robot1/stop");
  EXPECT_EQ(stop->status, 405);
  EXPECT_EQ(stop->get_header_value("Allow"), "POST");
  EXPECT_THAT(json::parse(stop->body)["error"].get<std::string>(),
              HasSubstr("takes POST, not GET"));
  const auto state = Client().Post("/api/state", "{}", "application/json");
  EXPECT_EQ(state->status, 405);
  EXPECT_EQ(state->get_header_value("Allow"), "GET, HEAD");
  EXPECT_EQ(Client().Delete("/api/site/plan")->status, 405);
  EXPECT_EQ(Client().Get("/api/nowhere")->status, 404);
}

// For who makes a client of it.
TEST(Description, NamesEachRequestAndTheTypeOfWhatMayBeNull) {
  json description;
  for (const File& file : Files()) {
    if (std::string(file.path) == "/api/openapi.yaml") {
      description = ReadDescription(std::string(file.bytes));
    }
  }
  std::vector<std::pair<std::string, json>> parts{{"", description}};
  while (!parts.empty()) {
    const auto [where, part] = parts.back();
    parts.pop_back();
    if (!part.is_structured()) continue;
    EXPECT_TRUE(!part.contains("nullable") || part.contains("type")) << where;
    for (const auto& [name, value] : part.items()) parts.emplace_back(where + "/" + name, value);
  }
  std::set<std::string> ids;
  std::set<std::string> tags;
  for (const json& tag : description["tags"]) tags.insert(tag["name"].get<std::string>());
  for (const auto& [path, methods] : description["paths"].items()) {
    for (const auto& [method, request] : methods.items()) {
      if (method == "parameters") continue;
      EXPECT_TRUE(ids.insert(request.value("operationId", "")).second) << method << " " << path;
      EXPECT_TRUE(tags.contains(request["tags"].at(0).get<std::string>())) << path;
    }
  }
  EXPECT_FALSE(ids.contains(""));
}

// In whatever form a client may send it.
TEST_F(WebTest, WhatMakesARobotStandIsObeyedWhateverComesWithIt) {
  const auto robot = bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  ASSERT_TRUE(robot->Publish(status));
  test::Await([&] { return !json::parse(Client().Get("/api/state")->body)["robots"].empty(); },
              "the robot");
  std::atomic<bool> ends = false;
  std::mutex mutex;
  std::vector<exchange::NowCommand> heard;
  std::set<std::uint64_t> numbers;
  std::thread answering([&] {
    while (!ends) {
      for (const exchange::Message& message : robot->Take(milliseconds(10))) {
        const auto* command = std::get_if<exchange::NowCommand>(&message);
        if (command == nullptr) continue;
        {
          const std::scoped_lock lock(mutex);
          if (numbers.insert(command->number).second) heard.push_back(*command);
        }
        (void)robot->Publish(exchange::NowAnswer{
            .agent = AgentId("robot1"), .client = command->client, .number = command->number});
      }
    }
  });
  const std::string json_type = "Content-Type: application/json\r\n";
  const std::vector<std::pair<std::string, std::string>> forms{
      {"", ""},
      {json_type, ""},
      {json_type + "Content-Length: 0\r\n", ""},
      {"Content-Length: 17\r\n", R"({"reason":"rain"})"},
      {"Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 17\r\n",
       R"({"reason":"rain"})"},
      {json_type + "Transfer-Encoding: chunked\r\n", "11\r\n{\"reason\":\"rain\"}\r\n0\r\n\r\n"},
      {json_type + "Content-Length: 24\r\n", R"({"reason":"rain","by":1})"},
      {json_type + "Content-Length: 1\r\n", "{"},
      {json_type + "Content-Length: 100000000\r\n", "{"},
      {"Content-Type: multipart/form-data\r\nContent-Length: 4\r\n", "rain"}};
  for (const char* order : {"all/stop", "robots/robot1/stop", "robots/robot1/pause",
                            "robots/robot1/cancel", "robots/robot1/end"}) {
    for (const auto& [head, body] : forms) {
      {
        const std::scoped_lock lock(mutex);
        heard.clear();
      }
      const test::RawConnection client(web_->port());
      client.Send(
          fmt::format("POST /api/{} HTTP/1.1\r\nHost: desk.site\r\n{}\r\n{}", order, head, body));
      // On a busy machine the answer of a robot that has heard may be late.
      EXPECT_THAT(client.Receive(), testing::AnyOf(HasSubstr(" 200 "), HasSubstr(" 504 ")))
          << order << " " << head << body;
      const std::scoped_lock lock(mutex);
      EXPECT_EQ(heard.size(), 1U) << order << " " << head << body;
      if (heard.empty()) continue;
      EXPECT_THAT(std::string("/") + order,
                  testing::EndsWith(fmt::format("/{}", mission::ToString(heard[0].order))));
      EXPECT_EQ(heard[0].reason, body.find("rain\"") == std::string::npos ? "" : "rain");
    }
  }
  const auto status_of = [&](const char* order, const std::string& head, const char* body) {
    const test::RawConnection client(web_->port());
    client.Send(fmt::format("POST /api/robots/robot1/{} HTTP/1.1\r\nHost: desk.site\r\n{}\r\n{}",
                            order, head, body));
    return client.Receive().substr(9, 3);
  };
  for (const char* order : {"resume", "release"}) {
    for (const std::string& head : {std::string(), json_type}) {
      EXPECT_THAT(status_of(order, head, ""), testing::AnyOf("200", "504"))
          << "a reason is optional";
    }
    EXPECT_EQ(status_of(order, "Content-Length: 2\r\n", "{}"), "415");
    EXPECT_EQ(status_of(order, json_type + "Content-Length: 1\r\n", "{"), "400")
        << "it may drive after that";
  }
  EXPECT_EQ(status_of("stop", "Origin: http://evil.example\r\n", ""), "403");
  ends = true;
  answering.join();
}

TEST_F(WebTest, ARobotThatTeachesIsDrivenByOneAtATime) {
  // However long the requests take, no driver has been silent for long enough to lose the seat.
  Desk desk{AgentId("counter"), bus_.Open(ConsoleTopics()),
            Desk::Options{.driving_clock = [] { return Driving::Time(std::chrono::hours(9)); }}};
  const auto web = Web::Open(desk, atlas_, nullptr, "localhost", 0, {}).value();
  httplib::Client client("localhost", web->port());
  client.set_logger(ExpectAsDescribed());
  client.set_read_timeout(test::kLongEnough);
  const auto robot = bus_.Open(program::WithAgents(exchange::TeachingTopics()));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kTeaching;
  ASSERT_TRUE(robot->Publish(status));
  ASSERT_TRUE(test::Await(
      [&] {
        const json state = json::parse(client.Get("/api/state")->body);
        return state["robots"][0].value("teaches", false);
      },
      "the robot to teach"));
  const auto drive = [&](const char* body) {
    return client.Post("/api/robots/robot1/drive", body, "application/json")->status;
  };
  EXPECT_EQ(drive(R"({"linear_mps":0.4,"turn_radps":-0.2,"driver":"ann","said_ms":100000})"), 200);
  EXPECT_EQ(drive(R"({"linear_mps":1,"turn_radps":0,"driver":"bob","said_ms":5})"), 409);
  EXPECT_EQ(drive(R"({"linear_mps":1,"turn_radps":0,"driver":"ann","said_ms":99000})"), 409);
  EXPECT_EQ(drive(R"({"linear_mps":1e9,"turn_radps":0,"driver":"ann","said_ms":100001})"), 400);
  EXPECT_EQ(drive(R"({"linear_mps":1,"driver":"ann","said_ms":100001})"), 400);
  for (int i = 0; i < 200; ++i) {
    for (const exchange::Message& message : robot->Take(milliseconds(50))) {
      const auto* heard = std::get_if<exchange::DriveCommand>(&message);
      if (heard == nullptr) continue;
      EXPECT_EQ(heard->agent, AgentId("robot1"));
      EXPECT_EQ(heard->client, AgentId("counter"));
      EXPECT_EQ(heard->linear_mps, 0.4);
      EXPECT_EQ(heard->turn_radps, -0.2);
      return;
    }
  }
  FAIL() << "the robot has heard nothing";
}

TEST_F(WebTest, WhatACameraSeesIsAPictureOrWhyThereIsNone) {
  const auto robot = bus_.Open(program::WithAgents(exchange::OnDutyTopics()));
  std::atomic<bool> ends = false;
  std::thread answering([&] {
    bool blind = false;
    while (!ends) {
      for (const exchange::Message& message : robot->Take(milliseconds(10))) {
        const auto* request = std::get_if<exchange::SnapshotRequest>(&message);
        if (request == nullptr || request->agent != AgentId("robot1")) continue;
        exchange::Snapshot snapshot{.agent = request->agent,
                                    .client = request->client,
                                    .request = request->request,
                                    .marked = true,
                                    .detail = "turns \xC3\xA9 left"};
        if (!blind) snapshot.picture = {0xFF, 0xD8, 0x00};
        blind = true;
        (void)robot->Publish(snapshot);
      }
    }
  });
  // A caller that is answered waits for no longer than that takes.
  Desk patient{AgentId("patient"), bus_.Open(ConsoleTopics()),
               Desk::Options{.answer_within = test::kLongEnough}};
  const auto web = Web::Open(patient, atlas_, nullptr, "localhost", 0, {}).value();
  httplib::Client client("localhost", web->port());
  client.set_read_timeout(test::kLongEnough);
  const auto picture = client.Get("/api/robots/robot1/snapshot");
  const auto none = client.Get("/api/robots/robot1/snapshot");
  const auto silent = Client().Get("/api/robots/robot7/snapshot");
  ends = true;
  answering.join();
  ASSERT_TRUE(picture && none && silent);
  EXPECT_EQ(picture->status, 200);
  EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(picture->get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(picture->get_header_value("Trailcast-Seen"), "turns ?? left");
  EXPECT_EQ(picture->get_header_value("Trailcast-Marked"), "1");
  EXPECT_EQ(picture->body, std::string("\xFF\xD8\0", 3));
  EXPECT_EQ(none->status, 404);
  EXPECT_THAT(json::parse(none->body)["error"].get<std::string>(), HasSubstr("turns"));
  EXPECT_EQ(silent->status, 504);
  EXPECT_THAT(json::parse(silent->body)["error"].get<std::string>(), HasSubstr("robot7"));
}

TEST_F(WebTest, WhatOdometryIsTrustedForIsTold) {
  const auto robot = bus_.Open(program::WithAgents(exchange::FollowerTopics()));
  exchange::AgentStatus status;
  status.agent = AgentId("robot1");
  status.role = exchange::AgentRole::kFollower;
  status.mode = exchange::AgentMode::kReplaying;
  status.following =
      exchange::Following{exchange::CarriedBy::kViews, exchange::OdometryTrust{4, 1.1}};
  ASSERT_TRUE(robot->Publish(status));
  std::string said;
  ASSERT_TRUE(test::Await(
      [&] {
        const json robots = json::parse(Client().Get("/api/state")->body)["robots"];
        if (!robots.empty()) said = robots[0].value("follows_by", "");
        return !said.empty();
      },
      "the robot to say what it follows by"));
  EXPECT_EQ(said, "Odometry: not believed; the pictures carry the robot");
}

TEST_F(WebTest, ANarrowAnswerTellsTheConsolesTime) {
  const auto state = Client().Get("/api/state");
  ASSERT_TRUE(state);
  const json shown = json::parse(state->body);
  EXPECT_GT(shown["now_unix_ms"], 1'000'000'000'000);
  EXPECT_EQ(shown["robots"], json::array());
}

TEST_F(WebTest, AShapeThatCannotBeFetchedSaysWhy) {
  const std::string id(32, 'a');
  EXPECT_EQ(Client().Get("/api/routes/hall/shape")->status, 404);
  EXPECT_EQ(Client().Get("/api/routes/" + id + "/shape?teaching=x")->status, 400);
  EXPECT_EQ(Client().Get("/api/routes/" + id + "/shape?teaching=0")->status, 400);
  const auto shape = Client().Get("/api/routes/" + id + "/shape?teaching=1f");
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->status, 503) << "no server";
  EXPECT_THAT(json::parse(shape->body)["error"].get<std::string>(), HasSubstr("no route server"));
}

TEST_F(WebTest, WithoutAFolderNothingIsPutUponASite) {
  const std::string id(32, 'a');
  EXPECT_EQ(json::parse(Client().Get("/api/site")->body)["kept"], false);
  EXPECT_EQ(Client().Get("/api/site/plan")->status, 404);
  const std::string put = R"({"x_m": 1, "y_m": 2, "heading_rad": 0, "scale": 1})";
  EXPECT_EQ(Client().Put("/api/site/placements/" + id, put, "application/json")->status, 409);
  EXPECT_EQ(Client().Get("/api/site/geojson")->status, 409);
}

TEST_F(WebTest, WhatIsPutUponASiteWithAnOriginIsExported) {
  const test::TempDir folder;
  std::ofstream(folder / "site.json")
      << R"({"origin": {"longitude_deg": 11.5, "latitude_deg": 48.2}})";
  const auto site = Site::Open(folder / "");
  ASSERT_TRUE(site) << site.error().message;
  web_ = Web::Open(desk_, atlas_, site->get(), "localhost", 0, {"desk.site"}).value();
  const auto empty = Client().Get("/api/site/geojson");
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->status, 200) << empty->body;
  EXPECT_EQ(empty->get_header_value("Content-Type"), "application/geo+json");
  EXPECT_EQ(json::parse(empty->body)["type"], "FeatureCollection");
  const auto place = [&](int number) {
    const std::string id = std::string(30, 'a') + std::to_string(number);
    const std::string put = R"({"x_m": 1, "y_m": 2, "heading_rad": 0, "scale": 1})";
    EXPECT_EQ(Client().Put("/api/site/placements/" + id, put, "application/json")->status, 200);
    return id;
  };
  const std::string id = place(10);
  EXPECT_EQ(Client().Get("/api/site/geojson")->status, 503) << "no server has it";
  EXPECT_EQ(Client().Get("/api/site/geojson?route=" + std::string(32, 'b'))->status, 200);
  for (int number = 11; number <= 10 + static_cast<int>(Atlas::kMostAsked); ++number) {
    (void)place(number);
  }
  const auto many = Client().Get("/api/site/geojson");
  EXPECT_EQ(many->status, 409);
  EXPECT_THAT(many->body, HasSubstr("name some"));
}

TEST_F(WebTest, ARouteIsPutUponASiteByItsOwnPageAlone) {
  const test::TempDir folder;
  std::ofstream(folder / "plan.jpg", std::ios::binary) << "\xff\xd8\xff and so on";
  std::ofstream(folder / "site.json") << R"({"metres_per_pixel": 0.05})";
  const auto site = Site::Open(folder / "");
  ASSERT_TRUE(site) << site.error().message;
  web_ = Web::Open(desk_, atlas_, site->get(), "localhost", 0, {"desk.site"}).value();
  const auto plan = Client().Get("/api/site/plan");
  EXPECT_EQ(plan->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(plan->body.size(), 13U);

  const std::string path = "/api/site/placements/" + std::string(32, 'a');
  const std::string put = R"({"x_m": 1, "y_m": 2, "heading_rad": 0, "scale": 1})";
  EXPECT_EQ(Client().Put(path, put, "application/json")->status, 200);
  EXPECT_EQ(json::parse(Client().Get("/api/site")->body)["placements"].size(), 1U);
  EXPECT_EQ(
      Client().Put(path, {{"Origin", "http://evil.example"}}, put, "application/json")->status,
      403);
  EXPECT_EQ(Client().Put(path, "{", "application/json")->status, 400);
  EXPECT_EQ(Client().Put("/api/site/placements/hall", put, "application/json")->status, 404);
  EXPECT_EQ(Client().Delete(path)->status, 200);
  EXPECT_EQ(json::parse(Client().Get("/api/site")->body)["placements"].size(), 0U);
}

TEST_F(WebTest, EventsTellWhatHasChanged) {
  const auto robot = bus_.Open(program::WithAgents(exchange::FollowerTopics()));
  std::string events;
  bool said = false;
  (void)Client().Get("/api/events", [&](const char* data, std::size_t size) {
    events.append(data, size);
    if (!said && events.find("event: state") != std::string::npos) {
      exchange::AgentStatus status;
      status.agent = AgentId("robot1");
      status.role = exchange::AgentRole::kFollower;
      said = robot->Publish(status).has_value();
    }
    return events.find("robot1") == std::string::npos;
  });
  EXPECT_THAT(events, HasSubstr("data: {\"now_unix_ms\":"));
  EXPECT_THAT(events, HasSubstr("robot1"));
}

TEST_F(WebTest, OneStreamTooManyIsRefusedAndThosePagesThatCloseMakeRoom) {
  const std::string ask = "GET /api/events HTTP/1.1\r\nHost: desk.site\r\n\r\n";
  {
    std::vector<std::unique_ptr<test::RawConnection>> streams;
    for (int i = 0; i < Web::kMostStreams; ++i) {
      streams.push_back(std::make_unique<test::RawConnection>(web_->port()));
      streams.back()->Send(ask);
      ASSERT_THAT(streams.back()->Receive(), HasSubstr("200 OK")) << i;
    }
    const test::RawConnection one_more(web_->port());
    one_more.Send(ask);
    EXPECT_THAT(one_more.Receive(), HasSubstr(" 503 "));
    EXPECT_EQ(Client().Get("/")->status, 200) << "others are served";
  }
  const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
  std::string answer;
  while (answer.find("200 OK") == std::string::npos && std::chrono::steady_clock::now() < until) {
    const test::RawConnection again(web_->port());
    again.Send(ask);
    answer = again.Receive();
  }
  EXPECT_THAT(answer, HasSubstr("200 OK"));
}

TEST_F(WebTest, RequestsWithoutEndTakeNoMemory) {
  ASSERT_EQ(Client().Get("/")->status, 200);
  const std::size_t before = test::ResidentBytes();
  const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  const std::string post =
      "POST /api/all/stop HTTP/1.1\r\nHost: desk.site\r\nContent-Type: application/json\r\n";
  EXPECT_LT(test::RawConnection(web_->port())
                .SendForEver(post + "Transfer-Encoding: chunked\r\n\r\n", chunk),
            16U << 20U);
  EXPECT_LT(test::RawConnection(web_->port())
                .SendForEver(post + "Content-Length: 200000000\r\n\r\n", chunk),
            16U << 20U);
  EXPECT_LT(test::RawConnection(web_->port()).SendForEver("GET /", std::string(100'000, 'x')),
            16U << 20U);
  EXPECT_LT(test::ResidentBytes(), before + (16U << 20U));
  EXPECT_EQ(Client().Get("/")->status, 200);
}

}  // namespace
}  // namespace trailcast::console
