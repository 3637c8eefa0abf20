// Consoles in a fleet with keys: an operator's, and one who only looks.
#include <httplib.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/scenario/sharing/secured_fleet.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ConsoleWithKeysTest : public SecuredFleetTest {
 protected:
  void StartConsole(const std::string& keys) {
    console_ = StartAs(keys, "trailcast-console", {"--http-port", "0"}, "console");
    port_ = ConsolesPort(*console_);
    ASSERT_NE(port_, 0);
  }
  struct Replied {
    int status = 0;
    json body{};
  };
  static Replied Of(const httplib::Result& got) {
    return got ? Replied{got->status, json::parse(got->body, nullptr, false)} : Replied{};
  }
  [[nodiscard]] httplib::Client Client() const {
    httplib::Client client("localhost", port_);
    client.set_read_timeout(test::kLongEnough);
    client.set_logger(console::ExpectAsDescribed());
    return client;
  }
  Replied Get(const std::string& path) { return Of(Client().Get(path)); }
  Replied Post(const std::string& path, const json& body = json::object()) {
    return Of(Client().Post(path, body.dump(), "application/json"));
  }
  // Asks until `is_so`; the last answer.
  template <typename IsSo>
  Replied GetUntil(const std::string& path, const IsSo& is_so) {
    const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
    Replied got = Get(path);
    while (!is_so(got) && std::chrono::steady_clock::now() < until) got = Get(path);
    EXPECT_TRUE(is_so(got)) << path << ": " << got.status << " " << got.body.dump()
                            << console_->output();
    return got;
  }
  // The one that is taught, as the console lists it.
  json Route() {
    const Replied page = GetUntil("/api/routes", [](const Replied& got) {
      return got.status == 200 && got.body["routes"].size() == 1;
    });
    return page.body["routes"].empty() ? json::object() : page.body["routes"][0];
  }
  Replied Shape(const json& route) {
    return GetUntil("/api/routes/" + route.value("route", "") + "/shape",
                    [](const Replied& got) { return got.status != 202; });
  }
  json AtItsEnd(const Replied& started) {
    EXPECT_EQ(started.status, 202) << started.body.dump();
    return GetUntil("/api/transfers/" + started.body.value("transfer", "none"),
                    [](const Replied& got) { return got.body.value("state", "") != "under way"; })
        .body;
  }

  std::unique_ptr<Process> console_;
  int port_ = 0;
};

TEST_F(ConsoleWithKeysTest, AnOperatorsConsoleDrawsDownloadsUploadsAndActivatesRoutes) {
  auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  StartConsole(operator_keys_);
  const json route = Route();
  const Replied shape = Shape(route);
  ASSERT_EQ(shape.status, 200) << shape.body.dump();
  EXPECT_EQ(shape.body["segments"], route["segments"]);

  const json fetched = AtItsEnd(
      Post("/api/transfers", {{"route", route["route"]}, {"teaching", route["teaching"]}}));
  ASSERT_EQ(fetched["state"], "done") << fetched.dump() << console_->output();
  const auto file =
      Client().Get("/api/transfers/" + fetched["transfer"].get<std::string>() + "/file");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->status, 200);
  EXPECT_GT(file->body.size(), route["bytes"].get<std::size_t>());

  const auto exported =
      RunAs(operator_keys_, "trailcast", {"export", "hall", "--out", Path("hall.trailcast")});
  EXPECT_EQ(exported.status, 0) << exported.output;
  EXPECT_EQ(RunAs(operator_keys_, "trailcast", {"routes", "--long"}).status, 0);

  // To a server that has nothing yet.
  server->Signal(SIGTERM);
  ASSERT_TRUE(server->Wait());
  server = StartAs(server_keys_, "trailcast-server", {"--store", Path("second.db")}, "second");
  ASSERT_TRUE(server->WaitForOutput("ready")) << server->output();
  EXPECT_TRUE(
      GetUntil("/api/routes",
               [](const Replied& got) { return got.status == 200 && got.body["routes"].empty(); })
          .body["routes"]
          .empty());
  const json given =
      AtItsEnd(Of(Client().Post("/api/transfers/uploads", file->body, "application/octet-stream")));
  ASSERT_EQ(given["state"], "done") << given.dump() << console_->output();
  EXPECT_THAT(given["detail"].get<std::string>(), HasSubstr("is there now"));
  EXPECT_EQ(Route()["route"], route["route"]);
  const auto imported = RunAs(operator_keys_, "trailcast", {"import", Path("hall.trailcast")});
  EXPECT_EQ(imported.status, 0) << imported.output;
  const Replied activated =
      Post("/api/routes/" + route["route"].get<std::string>() + "/edits", {{"action", "activate"}});
  EXPECT_EQ(activated.status, 200) << activated.body.dump();
}

TEST_F(ConsoleWithKeysTest, AnObserversConsoleShowsAndRefusesOrders) {
  const auto server = SecuredServer();
  ASSERT_EQ(Teach(scout_keys_).status, 0);
  StartConsole(observer_keys_);
  EXPECT_EQ(Get("/api/state").status, 200);
  EXPECT_EQ(Get("/api/me").body["role"], "look");
  const json route = Route();
  EXPECT_EQ(route["name"], "hall");
  for (const std::string path :
       {"/api/all/stop", "/api/robots/robot2/missions", "/api/robots/robot2/drive",
        "/api/routes/hall/edits", "/api/network/edits", "/api/transfers/uploads"}) {
    const Replied refused = Post(path);
    EXPECT_EQ(refused.status, 403) << path;
    EXPECT_THAT(refused.body.value("error", ""), HasSubstr("has the keys of 'guest'")) << path;
  }
  const Replied network = Get("/api/network");
  EXPECT_EQ(network.status, 200) << network.body.dump();
  EXPECT_EQ(network.body["routes"], 0);
  if (Browser::IsThere()) {
    Browser browser(folder_ / "");
    ASSERT_TRUE(browser.runs()) << browser.log();
    browser.Open("http://localhost:" + std::to_string(port_) + "/#network");
    EXPECT_TRUE(browser.WaitForText("No routes are joined")) << browser.Text();
    EXPECT_THAT(browser.Text(), testing::Not(HasSubstr("Send a robot")));
  }
  // Its keys give it no segments, and that is said.
  const Replied shape = Shape(route);
  EXPECT_EQ(shape.status, 503);
  EXPECT_THAT(shape.body.value("error", ""), HasSubstr("are of the role 'observer'"));
  const json fetched = AtItsEnd(
      Post("/api/transfers", {{"route", route["route"]}, {"teaching", route["teaching"]}}));
  EXPECT_EQ(fetched["state"], "failed");
  EXPECT_THAT(fetched["detail"].get<std::string>(), HasSubstr("are of the role 'observer'"));
}

}  // namespace
}  // namespace trailcast::test
