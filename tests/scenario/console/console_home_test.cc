// The console's home on a desk's screen, in Chromium.
#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

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
  int Send(const std::string& id, const std::string& orders) {
    return Post("/api/robots/robot1/missions", {{"orders", orders}, {"id", id}}).status;
  }
  // What the timeline says of a mission, after its state; empty: it has no bar.
  static std::string Bar(Browser& browser, const std::string& mission) {
    const json bar = browser.Run("const bar = document.querySelector(\".bar[href$=':" + mission +
                                 "']\");"
                                 "return bar ? bar.className + ' ' + bar.title : ''");
    return bar.is_string() ? bar.get<std::string>() : bar.dump();
  }
  static bool WaitForBar(Browser& browser, const std::string& mission, const std::string& text) {
    return WaitUntil([&] { return Bar(browser, mission).find(text) != std::string::npos; });
  }
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

}  // namespace
}  // namespace trailcast::test
