// These open a robot's run on a mission again from its log, in Chromium.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;

class ConsoleRunsTest : public ConsoleFleetTest {
 protected:
  static constexpr const char* kRight = "\xEE\x80\x94";

  // Until the words and the picture are those of that frame.
  static bool ShowsFrame(Browser& browser, int row) {
    return WaitUntil([&] {
      return browser.Run(
                 "return [...document.querySelectorAll('.run [data-row]')].map("
                 "each => Number(each.dataset.row))") == json::array({row, row});
    });
  }
};

TEST_F(ConsoleRunsTest, ARunIsOpenedAgainFrameByFrame) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Teach();
  server_ = Server();
  ASSERT_TRUE(Publish());
  robot_ = Robot("robot1", {});
  std::filesystem::create_directories(folder_ / "logs");
  agent_ = Agent(With({"serve", "--store", Path("routes.db"), "--name", "robot1", "--logs",
                       Path("logs/robot1")},
                      Drives("robot1")),
                 "duty");
  ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
  StartConsole({"--logs", Path("logs")});
  ASSERT_TRUE(WaitForState("available"));
  const auto sent = Post("/api/robots/robot1/missions", {{"orders", "follow hall"}});
  ASSERT_EQ(sent.status, 200);
  const std::string mission = sent.body["mission"];
  json runs;
  ASSERT_TRUE(WaitUntil([&] {
    runs = Get("/api/runs?mission=" + mission).value("runs", json::array());
    return runs.size() == 1 && runs[0]["state"] == "ARRIVED";
  })) << runs
      << agent_->output() << console_->output();
  EXPECT_EQ(runs[0]["robot"], "robot1");
  EXPECT_EQ(runs[0]["route"], "hall");

  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 1400);
  browser.Open(Page() + "#history/runs");
  ASSERT_TRUE(browser.WaitForText("ARRIVED")) << browser.Text();
  browser.Screenshot(Shot("runs"));
  ASSERT_TRUE(browser.Click("//td/a[contains(., 'hall')]"));
  ASSERT_TRUE(browser.WaitForText("arrived at the end of the route")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("What happened")) << browser.Text();
  ASSERT_TRUE(ShowsFrame(browser, 0)) << browser.Text() << console_->output();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(browser.HoldKey(kRight, 0));
  ASSERT_TRUE(ShowsFrame(browser, 3)) << browser.Text();
  ASSERT_TRUE(browser.Click("//button[@aria-label='Ten frames on']"));
  ASSERT_TRUE(ShowsFrame(browser, 13)) << browser.Text();
  // A place on the strip is a place of the run.
  ASSERT_TRUE(browser.Click("//*[local-name()='svg'][contains(@aria-label, 'The run')]"));
  const int rows = Get("/api/runs/" + runs[0]["run"].get<std::string>())["rows"];
  ASSERT_TRUE(WaitUntil([&] {
    const json row = browser.Run("return Number(document.querySelector('.says').dataset.row)");
    return row.is_number() && row > rows / 4 && row < 3 * rows / 4;
  })) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelector('.frame image') !== null") == json(true);
  })) << browser.Text();
  EXPECT_TRUE(browser.WaitForText("agree with the route")) << browser.Text();
  browser.Screenshot(Shot("run"));
  browser.Look(1280, 1400, true);
  browser.Screenshot(Shot("run-dark"));
  browser.Look(390, 2200);
  browser.Screenshot(Shot("phone-run"));

  // From the mission that it was.
  browser.Look(1280, 1400);
  browser.Open(Page() + "#history");
  ASSERT_TRUE(browser.Click("//button[contains(., 'follow hall')]"));
  ASSERT_TRUE(browser.Click("//p[contains(., 'Its runs')]/a")) << browser.Text();
  EXPECT_TRUE(browser.WaitForText("What happened")) << browser.Text();
}

}  // namespace
}  // namespace trailcast::test
