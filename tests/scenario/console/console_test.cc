// The console: a fleet over HTTP, and in a browser.
#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/places.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::seconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;

class ConsoleTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    Teach();
    server_ = Server();
    ASSERT_TRUE(Publish());
    ASSERT_NO_FATAL_FAILURE(PutOnDuty({"--sim-truth", Path("truth.csv"), "--sim-battery", "1000"}));
    StartConsole();
  }
};

TEST_F(ConsoleTest, ARobotIsSentPausedStoppedReleasedAndArrives) {
  ASSERT_TRUE(WaitForState("available")) << State().dump(2) << console_->output();
  EXPECT_EQ(State()["routes"], json::array()) << "no robot is on one";
  EXPECT_TRUE(WaitUntil([&] { return State()["servers"][0]["heard"] == true; }));
  EXPECT_TRUE(WaitUntil([&] { return Robot1()["battery_percent"] > 90; })) << Robot1();
  EXPECT_NE(Robot1()["software"], "");

  const Replied sent =
      Post("/api/robots/robot1/missions", {{"orders", "follow hall"}, {"id", "trip"}});
  EXPECT_EQ(sent.status, 200) << sent.body.dump();
  EXPECT_EQ(sent.body["mission"], "trip");
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2) << agent_->output();
  EXPECT_EQ(Robot1()["mission"]["orders"], "follow hall");
  EXPECT_TRUE(WaitUntil([&] { return Robot1()["length_m"].is_number(); })) << State().dump(2);
  EXPECT_EQ(State()["routes"][0]["name"], "hall");
  EXPECT_TRUE(WaitUntil([&] { return Robot1()["follows_by"] == "Odometry: trusted"; }))
      << Robot1().dump(2);

  const Replied paused = Post("/api/robots/robot1/pause", {{"reason", "somebody walks here"}});
  EXPECT_EQ(paused.status, 200) << paused.body.dump();
  EXPECT_EQ(paused.body["detail"], "paused by console: somebody walks here");
  ASSERT_TRUE(WaitForState("paused")) << State().dump(2);
  EXPECT_TRUE(Stands("truth.csv"));
  EXPECT_EQ(Robot1()["orders"], json({"resume", "cancel", "stop"}));
  EXPECT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);

  const Replied stopped = Post("/api/robots/robot1/stop");
  EXPECT_EQ(stopped.status, 200) << stopped.body.dump();
  ASSERT_TRUE(WaitForState("stopped")) << State().dump(2);
  EXPECT_TRUE(Stands("truth.csv"));
  EXPECT_LT(Along_m("truth.csv"), 4.3) << "of 4.5 m";
  const Replied refused = Post("/api/robots/robot1/resume");
  EXPECT_EQ(refused.status, 409) << refused.body.dump();
  EXPECT_THAT(refused.body["detail"].get<std::string>(), HasSubstr("release it first"));
  EXPECT_EQ(Post("/api/robots/robot1/release").status, 200);
  EXPECT_EQ(Post("/api/robots/robot1/resume").status, 200);
  EXPECT_TRUE(WaitUntil([&] {
    const json robot = Robot1();
    return robot["state"] == "driving" && robot["mission"].is_object() &&
           robot["mission"]["detail"] == "";
  })) << "that it stood is said no longer: "
      << Robot1().dump(2);
  ASSERT_TRUE(WaitUntil([&] {
    const auto got = Client().Get("/api/missions?robot=robot1");
    return got && got->body.find("\"arrived\"") != std::string::npos;
  })) << State().dump(2)
      << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 4.5, 0.25);
}

TEST_F(ConsoleTest, WhatIsWrongIsSaidAndWhoFallsSilentStaysListed) {
  ASSERT_TRUE(WaitForState("available")) << State().dump(2);
  EXPECT_EQ(Post("/api/robots/robot1/missions", {{"orders", "dance"}}).status, 400);
  const Replied unknown = Post("/api/robots/robot1/missions", {{"orders", "follow attic"}});
  EXPECT_EQ(unknown.status, 409) << unknown.body.dump();
  EXPECT_THAT(unknown.body["detail"].get<std::string>(), HasSubstr("attic"));
  EXPECT_TRUE(WaitUntil([&] {
    const std::string detail = Robot1().value("detail", "");
    return detail.find("refused") != detail.npos && detail.find("attic") != detail.npos;
  })) << State().dump(2);
  const Replied nothing = Post("/api/robots/robot1/cancel");
  EXPECT_EQ(nothing.status, 409) << nothing.body.dump();
  EXPECT_EQ(nothing.body["detail"], "has no mission to cancel");
  EXPECT_EQ(Post("/api/robots/robot7/pause").status, 504);
  const Replied nobody = Post("/api/robots/robot7/missions", {{"orders", "follow hall"}});
  EXPECT_EQ(nobody.status, 404) << nobody.body.dump();
  EXPECT_THAT(nobody.body["error"].get<std::string>(), HasSubstr("did you mean 'robot1'?"));
  // The command meets the server alone.
  const Words to_nobody{"send", "robot7", "follow", "hall"};
  const Ended refused = End(*Start("trailcast", to_nobody, "send-nobody"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.output, HasSubstr("did you mean 'robot1'?"));
  const Ended sent = End(*Start("trailcast", With(to_nobody, {"--unheard"}), "send-unheard"));
  EXPECT_EQ(sent.status, 0) << sent.output;
  EXPECT_THAT(
      sent.output,
      HasSubstr("a server keeps it, and hands it over in its turn; waits: it is not heard"));
  EXPECT_EQ(Post("/api/robots/robot1/dance").status, 404);
  EXPECT_EQ(Post("/api/robots/robot1/missions", {{"orders", "wait 600"}, {"id", "long"}}).status,
            200);
  ASSERT_TRUE(WaitUntil([&] { return Robot1()["mission"].is_object(); }));

  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  ASSERT_TRUE(WaitForState("offline")) << State().dump(2);
  const json robot = Robot1();
  EXPECT_EQ(robot["heard"], false);
  EXPECT_EQ(robot["needs_person"], true) << "in the middle of a mission";
  EXPECT_TRUE(robot["last_heard_unix_ms"].is_number());
  EXPECT_EQ(Post("/api/robots/robot9/forget").status, 404);
  EXPECT_EQ(Post("/api/robots/robot1/forget").status, 200) << "a person knows where it is";
  EXPECT_TRUE(WaitUntil([&] { return Robot1().empty(); }));
  server_->Signal(SIGTERM);
  (void)End(*server_);
  EXPECT_TRUE(WaitUntil([&] { return State()["servers"][0]["heard"] == false; }));
  console_->Signal(SIGTERM);
  EXPECT_EQ(End(*console_).status, 0) << console_->output();
}

TEST_F(ConsoleTest, AlertsOutliveTheConsoleAndEndWithTheirCause) {
  console_.reset();
  StartConsole({"--alerts", Path("alerts.json")});
  ASSERT_TRUE(WaitForState("available")) << State().dump(2);
  ASSERT_EQ(Post("/api/robots/robot1/missions", {{"orders", "follow hall"}}).status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);
  ASSERT_EQ(Post("/api/robots/robot1/pause", {{"reason", "somebody walks here"}}).status, 200);
  const auto alerts = [&] {
    const json found = State().value("alerts", json::array());
    return found.empty() ? json::object() : found[0];
  };
  ASSERT_TRUE(WaitUntil([&] { return alerts().value("kind", "") == "held"; })) << State().dump(2);
  const json held = alerts();
  EXPECT_THAT(held["reason"].get<std::string>(), HasSubstr("somebody walks here"));
  EXPECT_THAT(held["place"].get<std::string>(), HasSubstr(" m of hall"));
  const std::string path = "/api/alerts/" + held["alert"].get<std::string>() + "/acknowledge";
  ASSERT_EQ(Post(path).status, 200);
  ASSERT_TRUE(WaitUntil([&] {
    std::ifstream file(Path("alerts.json"));
    const json kept = json::parse(file, nullptr, false);
    return kept.is_object() && kept["alerts"][0]["acknowledged_by"] == "console";
  }));

  console_->Signal(SIGKILL);
  (void)End(*console_);
  StartConsole({"--alerts", Path("alerts.json")});
  ASSERT_TRUE(WaitUntil([&] { return alerts().value("known", false); })) << State().dump(2);
  EXPECT_EQ(alerts()["alert"], held["alert"]);
  EXPECT_EQ(alerts()["since_unix_ms"], held["since_unix_ms"]);
  EXPECT_EQ(alerts()["acknowledged_by"], "console");
  EXPECT_EQ(Get("/api/alerts")["kept"], true);
  ASSERT_EQ(Post("/api/robots/robot1/resume").status, 200);
  EXPECT_TRUE(WaitUntil([&] { return alerts().empty(); })) << State().dump(2);
  EXPECT_TRUE(Get("/api/alerts")["alerts"][0]["ended_unix_ms"].is_number());
}

TEST_F(ConsoleTest, AllAreStoppedAtOnce) {
  ASSERT_TRUE(WaitForState("available")) << State().dump(2);
  EXPECT_EQ(Post("/api/robots/robot1/missions", {{"orders", "follow hall"}}).status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);
  const Replied stopped = Post("/api/all/stop");
  EXPECT_EQ(stopped.status, 200);
  EXPECT_EQ(stopped.body["robots"][0]["robot"], "robot1") << stopped.body.dump();
  EXPECT_EQ(stopped.body["robots"][0]["obeys"], true) << stopped.body.dump();
  EXPECT_TRUE(WaitForState("stopped"));
}

// A program of ten lines of shell.
TEST_F(ConsoleTest, TheExampleSendsARobotAndWaitsUntilItHasArrived) {
  if (std::system("command -v curl jq >/dev/null") != 0) {
    GTEST_SKIP() << "curl and jq are not installed";
  }
  ASSERT_TRUE(WaitForState("available")) << State().dump(2);
  const auto example = [&](const Words& words) {
    Process process(With({"/usr/bin/env", "CONSOLE=http://localhost:" + std::to_string(port_),
                          SourceDir() + "/config/examples/send_and_wait.sh", "robot1"},
                         words),
                    Path("example.log"));
    return End(process);
  };
  const Ended unknown = example({"follow", "attic"});
  EXPECT_EQ(unknown.status, 1) << unknown.output;
  EXPECT_THAT(unknown.output, HasSubstr("robot1: refused"));
  const Ended wrong = example({"dance"});
  EXPECT_NE(wrong.status, 0);
  EXPECT_THAT(wrong.output, HasSubstr("dance"));
  const Ended sent = example({"follow", "hall"});
  EXPECT_EQ(sent.status, 0) << sent.output << agent_->output();
  EXPECT_THAT(sent.output, HasSubstr("robot1: arrived"));
  EXPECT_NEAR(Along_m("truth.csv"), 4.5, 0.25);
}

TEST_F(ConsoleTest, APersonQueuesAMissionSeesWhatItWaitsForAndResumesTheQueueInABrowser) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("Available")) << browser.Text();
  ASSERT_EQ(Post("/api/robots/robot1/missions", {{"orders", "wait 600"}, {"id", "now"}}).status,
            200);
  ASSERT_TRUE(WaitUntil([&] { return Robot1()["mission"].is_object(); })) << State().dump(2);
  ASSERT_TRUE(browser.Click("//button[contains(., 'Queue')]")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Slide to send robot1 along hall")) << browser.Text();
  ASSERT_TRUE(browser.Type("//label[starts-with(., 'A photo every')]/input", "0.5"));
  ASSERT_TRUE(browser.Type("//label[starts-with(., 'Photos at')]/input", "hall@1, hall@2.5"));
  browser.Screenshot(Shot("phone-send-photos"));
  ASSERT_TRUE(browser.Type("//input[@type='range']", kSlide));
  ASSERT_TRUE(browser.WaitForText("waits: it does mission now: wait 600")) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] { return Robot1()["queue"].size() == 1U; })) << State().dump(2);
  EXPECT_EQ(Robot1()["queue"][0]["orders"], "photo every 0.5 at hall@1 at hall@2.5 follow hall");
  browser.Screenshot(Shot("phone-queue"));

  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  std::filesystem::remove(Path("routes.db.robot1.missions"));
  agent_ = Serve("robot1", "duty-without-missions");
  ASSERT_TRUE(browser.WaitForText("mission now did not arrive (failed)")) << browser.Text();
  ASSERT_TRUE(browser.Click("//article//button[. = 'Resume']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Driving")) << browser.Text() << agent_->output();
  EXPECT_TRUE(WaitUntil([&] { return Robot1()["queue"].empty(); })) << State().dump(2);
  ASSERT_TRUE(browser.Click("//article//button[. = 'Cancel mission']")) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] { return Robot1()["mission"].is_null(); })) << State().dump(2);
}

TEST_F(ConsoleTest, APersonSeesARobotSendsItAndStopsItInABrowser) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("robot1")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Available")) << browser.Text();
  EXPECT_THAT(browser.Text(), HasSubstr("emergency stop"));

  ASSERT_TRUE(browser.Click("//button[contains(., 'Send')]"));
  ASSERT_TRUE(browser.WaitForText("Slide to send robot1 along hall")) << browser.Text();
  browser.Screenshot(Shot("phone-send"));
  // A tap at the far end is no slide.
  (void)browser.Type("//input[@type='range']", "\xEE\x80\x90");  // End
  EXPECT_EQ(Robot1()["mission"], nullptr);
  ASSERT_TRUE(browser.Type("//input[@type='range']", kSlide));
  ASSERT_TRUE(browser.WaitForText("Driving")) << browser.Text() << agent_->output();
  ASSERT_TRUE(browser.WaitForText("Odometry: trusted")) << browser.Text();
  browser.Screenshot(Shot("phone-driving"));

  ASSERT_TRUE(browser.Click("//article//button[contains(@class, 'stop')]"));
  ASSERT_TRUE(browser.WaitForText("Stopped")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("stopped by console")) << browser.Text();
  EXPECT_TRUE(Stands("truth.csv"));
  EXPECT_LT(Along_m("truth.csv"), 4.3) << "of 4.5 m";
  browser.Screenshot(Shot("phone-stopped"));
  browser.Look(390, 844, true);
  browser.Screenshot(Shot("phone-dark"));
  browser.Look(1280, 800);
  browser.Screenshot(Shot("desktop"));

  EXPECT_EQ(Post("/api/robots/robot1/release").status, 200);
  EXPECT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);
  const auto stop_all_is = [&](const char* classes) {
    return WaitUntil([&] {
      return browser.Run("return document.querySelector('button.all').className") == json(classes);
    });
  };
  EXPECT_TRUE(stop_all_is("stop all")) << "it is filled while one may move";
  ASSERT_TRUE(browser.HoldKey("s", 50));
  ASSERT_TRUE(WaitForState("stopped")) << "one key: " << browser.Text();
  EXPECT_TRUE(stop_all_is("stop all stands")) << "it is outlined once all stand";
  ASSERT_TRUE(browser.HoldKey("/", 50));
  ASSERT_TRUE(browser.Type("//dialog/input", "release robot1\xEE\x80\x87"));  // Enter
  ASSERT_TRUE(WaitUntil([&] { return Robot1().value("state", "") != "stopped"; }))
      << browser.Text();
  EXPECT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);
  ASSERT_TRUE(browser.Click("//button[. = 'Stop all']"));
  ASSERT_TRUE(browser.WaitForText("robot1 stands.")) << browser.Text();
  EXPECT_EQ(Post("/api/robots/robot1/release").status, 200);
  EXPECT_TRUE(WaitUntil([&] { return browser.Text().find("robot1 stands.") == std::string::npos; }))
      << "what is so no longer is not said";
  EXPECT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(WaitForState("driving")) << State().dump(2);

  // The browser's own notifications and tones are not heard here.
  (void)browser.Run(
      "window.called = [];"
      "window.Notification = class { constructor(title) { window.called.push(title); } };"
      "window.Notification.permission = 'granted';"
      "window.Notification.requestPermission = async () => 'granted';"
      "window.AudioContext = class { constructor() { window.called.push('tone');"
      "  throw new Error('there are no loudspeakers'); } };"
      "document.hasFocus = () => false;");
  ASSERT_TRUE(browser.Click("//footer//option[. = 'a sound and a notification']"));

  agent_->Signal(SIGKILL);
  ASSERT_TRUE(browser.WaitForText("Offline")) << browser.Text();
  const Replied silent = Post("/api/all/stop");
  EXPECT_EQ(silent.status, 504) << silent.body;
  EXPECT_THAT(silent.body["text"].get<std::string>(),
              AllOf(HasSubstr("0 of 1 robots stand"), HasSubstr("m/s")))
      << silent.body;
  ASSERT_TRUE(browser.WaitForText("Not stopped: robot1")) << browser.Text();
  const Ended stop_all = End(*Start("trailcast", {"stop", "--all", "--timeout", "2"}, "stop-all"));
  EXPECT_EQ(stop_all.status, 1) << stop_all.output;
  EXPECT_THAT(stop_all.output, HasSubstr("robot1: did not answer: last known on its mission"));
  EXPECT_THAT(browser.Text(), AllOf(HasSubstr("Last seen"), HasSubstr("Needs attention")));
  ASSERT_TRUE(browser.WaitForText("Offline in the middle of its mission")) << browser.Text();
  const auto called = [&] { return browser.Run("return window.called").dump(); };
  EXPECT_TRUE(WaitUntil([&] {
    return called().find("robot1: Offline in the middle of its mission") != std::string::npos;
  })) << called();
  EXPECT_THAT(called(), HasSubstr("tone"));
  const auto title = [&] { return browser.Run("return document.title").dump(); };
  EXPECT_TRUE(WaitUntil([&] { return title().starts_with("\"(2) "); })) << title();
  ASSERT_TRUE(browser.Click("//li[contains(., 'Offline in the middle')]/button"));
  EXPECT_TRUE(WaitUntil([&] { return title().starts_with("\"(1) "); })) << title();
  browser.Look(1280, 800, true);
  browser.Screenshot(Shot("desktop-silent"));
  browser.Open("about:blank");
  EXPECT_TRUE(WaitUntil([&] {
    const auto metrics = Client().Get("/metrics");
    return metrics && metrics->body.find("\ntrailcast_console_streams 0\n") != std::string::npos;
  })) << "a page that was left is told nothing";
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("Offline")) << browser.Text();
  console_->Signal(SIGKILL);
  ASSERT_TRUE(browser.WaitForText("Connection lost: Stop will not reach robots")) << browser.Text();
  browser.Look(390, 844);
  browser.Screenshot(Shot("phone-lost"));
}

}  // namespace
}  // namespace trailcast::test
