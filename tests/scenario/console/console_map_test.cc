// The console's strip, shapes and site, in Chromium.
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "services/image/files.h"
#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::steady_clock;
using testing::HasSubstr;

class ConsoleMapTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    Teach();
    server_ = Server();
    ASSERT_TRUE(Publish());
    ASSERT_NO_FATAL_FAILURE(PutOnDuty());
  }
  // A floor of 8 by 4 m, its walls drawn.
  void DrawPlan() {
    std::filesystem::create_directory(folder_ / "site");
    image::GrayImage plan{160, 80, std::vector<std::uint8_t>(160U * 80U, 240)};
    for (int y = 0; y < plan.height; ++y) {
      for (int x = 0; x < plan.width; ++x) {
        const bool wall = x < 2 || y < 2 || x >= 158 || y >= 78 || (x == 100 && y < 50);
        if (wall) plan.pixels[image::PixelIndex(x, y, plan.width)] = 60;
      }
    }
    ASSERT_TRUE(image::WritePng(plan, folder_ / "site/plan.png"));
    std::ofstream(folder_ / "site/site.json") << R"({"metres_per_pixel": 0.05})";
  }
  // Pixels from the left at which a robot is drawn; below 0: it is not.
  static double DrawnAt(Browser& browser, const std::string& of) {
    const json at = browser.Run("const robot = document.querySelector('" + of +
                                " .on-line circle');"
                                "return robot ? robot.getBoundingClientRect().left : -1");
    return at.is_number() ? at.get<double>() : -1.0;
  }
  static bool Moves(Browser& browser, const std::string& of) {
    double from = -1.0;
    return WaitUntil([&] {
      const double at = DrawnAt(browser, of);
      if (from < 0.0) from = at;
      return from >= 0.0 && at > from + 3.0;
    });
  }
};

TEST_F(ConsoleMapTest, ARobotIsSeenOnItsLineOnItsShapeAndOnTheSite) {
  DrawPlan();
  StartConsole({"--site", Path("site")});
  ASSERT_TRUE(WaitForState("available"));
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open(Page());

  ASSERT_EQ(Post("/api/robots/robot1/missions", {{"orders", "follow hall speed 0.25"}}).status,
            200);
  ASSERT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelectorAll('.lines .cells').length") > json(0);
  })) << browser.Text()
      << console_->output();
  ASSERT_TRUE(Moves(browser, ".lines")) << browser.Text() << agent_->output();
  ASSERT_EQ(Post("/api/robots/robot1/pause", {{"reason", "somebody walks here"}}).status, 200);
  ASSERT_TRUE(browser.WaitForText("paused by console: somebody walks here")) << browser.Text();
  browser.Screenshot(Shot("line"));
  browser.Look(390, 844, true);
  browser.Screenshot(Shot("phone-line"));

  const std::string hall = Robot1().value("route_id", "");
  const json shape = Get("/api/routes/" + hall + "/shape");
  EXPECT_NEAR(shape["length"].get<double>(), 3.5, 0.3) << shape.dump();
  EXPECT_NEAR(shape["points"]["x_m"].back().get<double>(), 3.5, 0.3);
  EXPECT_EQ(shape["closing"], nullptr);

  ASSERT_TRUE(browser.Click("//label[contains(., 'Shape')]"));
  ASSERT_TRUE(browser.WaitForText("Odometry trace (may drift)")) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] { return DrawnAt(browser, ".plan") > 0.0; })) << browser.Text();
  browser.Screenshot(Shot("phone-shape"));
  browser.Look(1280, 800);
  ASSERT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(Moves(browser, ".plan")) << browser.Text() << agent_->output();
  browser.Screenshot(Shot("shape"));
  ASSERT_EQ(Post("/api/robots/robot1/pause").status, 200);

  // Put there with the keyboard; all of it is on the screen, which need not scroll.
  browser.Look(1280, 1500);
  ASSERT_TRUE(browser.Click("//label[contains(., 'Site')]"));
  ASSERT_TRUE(browser.WaitForText("hall, 3.5 m")) << browser.Text();
  ASSERT_TRUE(browser.Click("//select/option[contains(., 'hall')]")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Place hall")) << browser.Text();
  ASSERT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelector('.site image') !== null") == json(true);
  })) << "the floor plan";
  ASSERT_TRUE(browser.Click("//button[contains(., 'Place hall')]")) << browser.Text();
  ASSERT_TRUE(browser.Type("//*[@class='handles']",
                           "\xEE\x80\x92\xEE\x80\x93"
                           "e"));
  ASSERT_TRUE(browser.Click("//button[contains(., 'Save')]"));
  ASSERT_TRUE(browser.WaitForText("hall is placed")) << browser.Text();
  const json placed = Get("/api/site")["placements"][hall];
  EXPECT_NEAR(placed["x_m"].get<double>(), 3.9, 1e-6) << placed.dump() << "left, and up";
  EXPECT_NEAR(placed["y_m"].get<double>(), 2.1, 1e-6);
  EXPECT_NEAR(placed["heading_rad"].get<double>(), -0.0175, 1e-3);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "site/placements.json"));
  ASSERT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(Moves(browser, ".site")) << browser.Text() << agent_->output();
  browser.Screenshot(Shot("site"));
  browser.Look(390, 844, true);
  browser.Screenshot(Shot("phone-site"));
}

TEST_F(ConsoleMapTest, OfARouteThatIsNotKnownYetHowFarARobotIsIsSeen) {
  const Ended sent = End(*Start("trailcast", {"send", "robot1", "follow hall speed 0.1"}, "send"));
  ASSERT_EQ(sent.status, 0) << sent.output;
  ASSERT_TRUE(agent_->WaitForOutput("FOLLOWING")) << agent_->output();
  server_->Signal(SIGSTOP);
  StartConsole();
  ASSERT_TRUE(WaitUntil([&] {
    const json along = Robot1().value("along_m", json());
    return along.is_number() && along > json(0.1);
  })) << State().dump(2);
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open(Page());
  ASSERT_TRUE(WaitUntil([&] { return DrawnAt(browser, ".lines") > 0.0; })) << browser.Text();
  const json line = browser.Run(
      "const line = document.querySelector('.lines .line').getBoundingClientRect();"
      "return [line.left, line.width]");
  EXPECT_LT(DrawnAt(browser, ".lines"), line[0].get<double>() + 0.6 * line[1].get<double>())
      << State().dump(2);
  EXPECT_EQ(Robot1()["length_m"], json()) << "it became known meanwhile";
}

}  // namespace
}  // namespace trailcast::test
