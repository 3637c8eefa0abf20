// The console's home on a desk's screen, in Chromium.
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kSelected = "//section[@aria-label='Selected robots']";

class ConsoleHomeTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    Teach();
    server_ = Server();
  }
  void Begin() {
    ASSERT_TRUE(Publish());
    ASSERT_NO_FATAL_FAILURE(PutOnDuty());
    StartConsole();
    ASSERT_TRUE(WaitForState("available")) << State().dump(2);
  }
  // Besides robot1, with a store of its own.
  void AlsoPutOnDuty(const std::string& name) {
    others_.push_back(Robot(name, {"--picture-rate", "10"}));
    others_.push_back(Serve(name, name + "-duty", {}, name + ".db"));
    ASSERT_TRUE(others_.back()->WaitForOutput("available as")) << others_.back()->output();
  }
  std::string StateOf(const std::string& name) {
    const json state = State();
    for (const json& robot : state.value("robots", json::array())) {
      if (robot["name"] == name) return robot["state"];
    }
    return "";
  }
  bool WaitForStateOf(const std::string& name, const std::string& state) {
    return WaitUntil([&] { return StateOf(name) == state; });
  }
  // The robots that are sent along the hall, as servers keep it.
  std::set<std::string> Sent() {
    std::set<std::string> robots;
    const json found = Get("/api/missions?route=hall");
    for (const json& mission : found["missions"])
      robots.insert(mission["robot"].get<std::string>());
    return robots;
  }
  static void ClickOnRow(Browser& browser, const std::string& robot, const std::string& key) {
    (void)browser.Run("document.querySelector('#robot-" + robot +
                      " > a').dispatchEvent("
                      "new MouseEvent('click', {bubbles: true, cancelable: true, " +
                      key + ": true}))");
  }
  int Send(const std::string& id, const std::string& orders) {
    return Post("/api/robots/robot1/missions", {{"orders", orders}, {"id", id}}).status;
  }
  // Returns what the timeline says of a mission, after its state; empty if it has no bar.
  static std::string Bar(Browser& browser, const std::string& mission) {
    const json bar = browser.Run("const bar = document.querySelector(\".bar[href$=':" + mission +
                                 "']\");"
                                 "return bar ? bar.className + ' ' + bar.title : ''");
    return bar.is_string() ? bar.get<std::string>() : bar.dump();
  }
  static bool WaitForBar(Browser& browser, const std::string& mission, const std::string& text) {
    return WaitUntil([&] { return Bar(browser, mission).find(text) != std::string::npos; });
  }

  std::vector<std::unique_ptr<Process>> others_;  // a robot, its agent, and so on
};

TEST_F(ConsoleHomeTest, TheDaysMissionsAreBarsOfWhichEachOpensItsMission) {
  ASSERT_NO_FATAL_FAILURE(Begin());
  ASSERT_EQ(Send("early", "wait 1"), 200);
  ASSERT_TRUE(WaitUntil([&] {
    const json found = Get("/api/missions?mission=early");
    return found["missions"].size() == 1U && found["missions"][0]["state"] == "arrived";
  })) << State().dump(2);
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 900);
  browser.Open(Page());
  EXPECT_TRUE(WaitForBar(browser, "early", "bar arrived robot1: wait 1")) << browser.Text();

  EXPECT_EQ(Send("attic", "follow attic"), 409);
  EXPECT_TRUE(WaitForBar(browser, "attic", "bar failed")) << Bar(browser, "attic");
  ASSERT_EQ(Send("now", "wait 600"), 200);
  EXPECT_TRUE(WaitForBar(browser, "now", "bar driving")) << Bar(browser, "now");
  ASSERT_EQ(Send("next", "follow hall"), 200);
  EXPECT_TRUE(WaitForBar(browser, "next", "bar waiting")) << Bar(browser, "next");
  browser.Screenshot(Shot("timeline"));

  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  EXPECT_TRUE(WaitForBar(browser, "now", "as last known at")) << Bar(browser, "now");
  EXPECT_EQ(browser.Run("return document.querySelector(\".bar[href$=':now'] "
                        ".unknown\") !== null"),
            json(true))
      << "what became of it since is not known";
  browser.Look(1280, 900, true);
  browser.Screenshot(Shot("timeline-dark"));

  ASSERT_TRUE(browser.Click("//a[contains(@class, 'bar')][contains(@href, ':attic')]"));
  ASSERT_TRUE(browser.WaitForText("follow attic")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Ended: refused")) << browser.Text();
  EXPECT_THAT(browser.Text(), HasSubstr("All missions"));
  browser.Open(Page() + "#history/mission-robot1:nothing");
  EXPECT_TRUE(browser.WaitForText("No server keeps this mission.")) << browser.Text();

  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("wait 600")) << browser.Text();
  EXPECT_EQ(browser.Run("return document.querySelector('.timeline')"), json())
      << "a phone has the list instead";
}

TEST_F(ConsoleHomeTest, AnEmptyPageLeadsToAFirstRobotRouteAndMission) {
  StartConsole();
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("First steps")) << browser.Text();
  EXPECT_THAT(browser.Text(), HasSubstr("trailcast-agent serve"));
  const auto done = [&] {
    return browser.Run("return document.querySelectorAll('.guide li.done').length");
  };
  EXPECT_EQ(done(), json(0));
  browser.Screenshot(Shot("first-steps"));
  ASSERT_NO_FATAL_FAILURE(PutOnDuty());
  ASSERT_TRUE(browser.WaitForText("robot1 is heard.")) << browser.Text();
  // An available agent has its store to itself.
  Teach("scout.db");
  const Ended kept = RunAgent({"deliver", "--store", Path("scout.db"), "--name", "scout"});
  ASSERT_EQ(kept.status, 0) << kept.output;
  ASSERT_TRUE(browser.WaitForText("Route servers keep 1 route.")) << browser.Text();
  EXPECT_EQ(done(), json(2)) << browser.Text();
  ASSERT_EQ(Send("first", "follow hall"), 200);
  ASSERT_TRUE(WaitUntil([&] { return done() == json(3); })) << browser.Text();
  ASSERT_TRUE(browser.Click("//button[. = 'Hide']"));
  EXPECT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelector('.guide')") == json();
  })) << browser.Text();
}

TEST_F(ConsoleHomeTest, TheFirstViewIsSmallAndWhatIsOpenedSeldomIsLoadedWhenItIsOpened) {
  StartConsole();
  const std::string port = std::to_string(port_);
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("First steps")) << browser.Text();
  const auto loaded_bytes = [&](const std::string& name) {
    return browser.Run("return performance.getEntriesByType('resource').filter(each => /" + name +
                       "/.test(each.name)).reduce((sum, each) => sum + each.encodedBodySize, 0)");
  };
  const json script = loaded_bytes("[.]js$");
  std::printf("the first view has %d bytes of script and %d of style\n", script.get<int>(),
              loaded_bytes("[.]css$").get<int>());
  EXPECT_GT(script, json(0));
  EXPECT_LE(script, json(90000)) << "gzipped, as the browser got it";
  EXPECT_EQ(loaded_bytes("seldom"), json(0));

  console_->Signal(SIGKILL);
  (void)End(*console_);
  ASSERT_TRUE(browser.WaitForText("Connection lost")) << browser.Text();
  ASSERT_TRUE(browser.Click("//nav/a[. = 'Routes']")) << browser.Text();
  ASSERT_TRUE(
      browser.WaitForText("This part of the page could not be loaded. The console does not "
                          "answer."))
      << browser.Text();
  browser.Screenshot(Shot("not-loaded"));
  console_ = Start("trailcast-console", {"--http-port", port}, "console-again");
  ASSERT_EQ(std::to_string(ConsolesPort(*console_)), port);
  EXPECT_TRUE(browser.WaitForText("Activity log")) << "by itself, once the console is back\n"
                                                   << browser.Text();
  EXPECT_GT(loaded_bytes("seldom"), json(0));

  browser.Block({"*/code/seldom-*"});
  browser.Open("about:blank");
  browser.Open(Page() + "#network");
  ASSERT_TRUE(browser.WaitForText("or the console is of another version")) << browser.Text();
  browser.Block({});
  ASSERT_TRUE(browser.Click("//button[. = 'Try again']")) << browser.Text();
  EXPECT_TRUE(browser.WaitForText("Routes and places with")) << browser.Text();
}

TEST_F(ConsoleHomeTest, WhicheverRobotOfAGroupIsFreeFirstIsSentAndWhatWaitsIsListed) {
  most_mps_ = "0.06";  // on its way for a minute
  ASSERT_NO_FATAL_FAILURE(Begin());
  ASSERT_NO_FATAL_FAILURE(AlsoPutOnDuty("robot2"));
  ASSERT_NO_FATAL_FAILURE(AlsoPutOnDuty("cart1"));
  for (const char* robot : {"robot2", "cart1"}) {
    ASSERT_TRUE(WaitForStateOf(robot, "available")) << State().dump(2);
  }
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 1000);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("cart1")) << browser.Text();
  ASSERT_TRUE(browser.Click("//option[. = 'robot (2)']")) << browser.Text();
  const std::string group = "//section[@aria-label='Group robot']";
  const auto send = [&] {
    return browser.Click(group + "//button[starts-with(., 'Send one of robot')]") &&
           browser.WaitForText("Slide to send a free robot of robot along hall") &&
           browser.Type(group + "//input[@type='range']", kSlide);
  };
  const auto waiting = [&] {
    return browser.Run("return document.querySelectorAll('.several .queue li').length");
  };
  ASSERT_TRUE(send()) << browser.Text();
  ASSERT_TRUE(WaitForStateOf("robot1", "driving")) << State().dump(2);
  // So neither ends its mission while the browser is looked at, however slow that is.
  ASSERT_EQ(Post("/api/robots/robot1/pause").status, 200);
  ASSERT_TRUE(WaitForStateOf("robot1", "paused")) << State().dump(2);
  ASSERT_TRUE(send()) << browser.Text();
  ASSERT_TRUE(WaitForStateOf("robot2", "waiting")) << "behind robot1\n" << State().dump(2);
  ASSERT_TRUE(send()) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("no robot of @robot is free; robot1: paused by console"))
      << browser.Text();
  ASSERT_TRUE(WaitUntil([&] { return waiting() == json(1); })) << "two were given to robots\n"
                                                               << browser.Text();
  browser.Screenshot(Shot("group"));
  ASSERT_TRUE(browser.Click(group + "//button[. = 'Cancel what waits']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("what waits for the group is told so")) << browser.Text();
  EXPECT_EQ(Sent(), (std::set<std::string>{"@robot", "robot1", "robot2"})) << State().dump(2);
}

TEST_F(ConsoleHomeTest, SeveralRobotsAreSelectedAndToldAtOnceAndWhoDoesNotObeyIsNamed) {
  most_mps_ = "0.06";  // on its way for a minute
  ASSERT_NO_FATAL_FAILURE(Begin());
  ASSERT_NO_FATAL_FAILURE(AlsoPutOnDuty("robot2"));
  ASSERT_NO_FATAL_FAILURE(AlsoPutOnDuty("cart1"));
  for (const char* robot : {"robot2", "cart1"}) {
    ASSERT_TRUE(WaitForStateOf(robot, "available")) << State().dump(2);
  }
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 1000);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("cart1")) << browser.Text();

  ASSERT_TRUE(browser.Click("//option[. = 'robot (2)']")) << browser.Text();
  ASSERT_TRUE(browser.Click("//label[contains(., 'Select all')]/input")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("2 robots selected")) << browser.Text();
  ASSERT_TRUE(browser.Click(kSelected + "//button[contains(., 'Send')]")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Slide to send 2 robots along hall")) << browser.Text();
  ASSERT_TRUE(browser.Type(kSelected + "//input[@type='range']", kSlide));
  ASSERT_TRUE(browser.WaitForText("all 2 obeyed.")) << browser.Text();
  EXPECT_EQ(Sent(), (std::set<std::string>{"robot1", "robot2"})) << State().dump(2);

  ASSERT_TRUE(browser.Click(kSelected + "//button[. = 'Clear']")) << browser.Text();
  ASSERT_TRUE(browser.Click("//option[. = 'All groups']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("cart1")) << browser.Text();
  ClickOnRow(browser, "cart1", "ctrlKey");
  ASSERT_TRUE(browser.WaitForText("1 robot selected")) << browser.Text();
  ClickOnRow(browser, "robot2", "shiftKey");
  ASSERT_TRUE(browser.WaitForText("3 robots selected")) << browser.Text();
  others_.back()->Signal(SIGKILL);
  ASSERT_TRUE(WaitForStateOf("cart1", "offline")) << State().dump(2);
  ASSERT_TRUE(browser.Click(kSelected + "//button[. = 'Pause']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("2 of 3 obeyed. Did not:")) << browser.Text();
  EXPECT_THAT(browser.Text(), HasSubstr("cart1: did not answer"));
  browser.Screenshot(Shot("several"));
  ASSERT_TRUE(browser.Click(kSelected + "//button[. = 'Stop 3']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Not stopped: cart1")) << browser.Text();
  for (const char* robot : {"robot1", "robot2"}) {
    EXPECT_TRUE(WaitForStateOf(robot, "stopped")) << State().dump(2);
  }
  ASSERT_TRUE(browser.Click(kSelected + "//button[. = 'Resume']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("0 of 3 obeyed. Did not:")) << browser.Text();
  EXPECT_THAT(browser.Text(),
              AllOf(HasSubstr("robot1: Does not obey"), HasSubstr("release it first")));
}

TEST_F(ConsoleHomeTest, AWallsScreenShowsWhatIsThereAndHasNoButtonButStopAll) {
  most_mps_ = "0.06";
  ASSERT_NO_FATAL_FAILURE(Begin());
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1920, 1080, true);
  browser.Open(Page() + "#wall");
  ASSERT_TRUE(browser.WaitForText("1 available")) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelector('.wall-rows .state') !== null") == json(true);
  })) << browser.Text();
  EXPECT_EQ(browser.Run("return [...document.querySelectorAll('button, select, "
                        "input, summary')]"
                        ".filter(each => !each.closest('[inert]')).map(each => "
                        "each.innerText)"),
            json({"Stop all"}));
  const json letters_px = browser.Run(
      "return parseFloat(getComputedStyle(document.querySelector('.wall-rows "
      ".state')).fontSize)");
  EXPECT_GE(letters_px, json(40.0)) << "it is read from three metres";

  ASSERT_EQ(Send("trip", "follow hall"), 200);
  ASSERT_TRUE(browser.WaitForText("1 driving")) << browser.Text();
  ASSERT_EQ(Post("/api/robots/robot1/pause", {{"reason", "somebody walks here"}}).status, 200);
  ASSERT_TRUE(WaitUntil([&] {
    const json alerts = browser.Run(
        "const alerts = document.querySelector('.wall-alerts');"
        "return alerts ? alerts.innerText : ''");
    return alerts.is_string() &&
           alerts.get<std::string>().find("somebody walks") != std::string::npos;
  })) << browser.Text();
  browser.Screenshot(Shot("wall-dark"));
  ASSERT_TRUE(browser.Click("//button[. = 'Stop all']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("1 stopped")) << browser.Text();
  browser.Look(1920, 1080);
  browser.Screenshot(Shot("wall"));

  console_->Signal(SIGKILL);
  ASSERT_TRUE(browser.WaitForText("Connection lost: Stop will not reach robots")) << browser.Text();
  EXPECT_TRUE(browser.WaitForText("Last: Stopped")) << browser.Text();
  browser.Screenshot(Shot("wall-lost"));
}

}  // namespace
}  // namespace trailcast::test
