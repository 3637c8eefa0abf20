// Two people at once before three robots that drive, each in a browser of their own.
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_users.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::steady_clock;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ConsolePeopleTest : public ConsoleUsersTest {
 protected:
  // Each of a robot and a route of its own.
  static constexpr std::array<const char*, 3> kRobots{"robot1", "robot2", "robot3"};
  static constexpr std::array<const char*, 3> kRoutes{"hall", "bench", "back"};
  static constexpr std::array<const char*, 3> kPaths{"1,1.5\n6,1.5\n", "7.2,5.6\n5.8,7\n2.3,7\n",
                                                     "2.3,7\n5.8,7\n7.2,5.6\n"};

  void SetUp() override {
    ConsoleUsersTest::SetUp();
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    for (std::size_t i = 0; i < kRobots.size(); ++i) Teach("routes.db", kPaths[i], kRoutes[i]);
    server_ = Server();
    ASSERT_TRUE(Publish());
    for (std::size_t i = 0; i < kRobots.size(); ++i) StartRobot(kRobots[i], kPaths[i]);
    for (const auto& agent : agents_) {
      ASSERT_TRUE(agent->WaitForOutput("available as")) << agent->output();
    }
    AddUser("anna", "operate");
    AddUser("guest", "look");
    StartWithTls();
  }
  // So slow that it is on its way for more than a minute.
  void StartRobot(const std::string& name, const std::string& path) {
    simulated_.push_back(
        Robot(name, {"--picture-rate", "10", "--sim-truth", Path(name + ".csv")}, path));
    agents_.push_back(
        Agent(With({"serve", "--store", Path(name + ".db"), "--name", name, "--max-speed", "0.06"},
                   Drives(name)),
              name + "-agent"));
  }
  // A browser that `user` has logged in with.
  std::unique_ptr<Browser> Opened(const std::string& user, int width_px, int height_px) {
    std::filesystem::create_directory(folder_ / user);
    auto browser = std::make_unique<Browser>(folder_ / user);
    EXPECT_TRUE(browser->runs()) << browser->log();
    browser->Look(width_px, height_px);
    browser->Open("https://localhost:" + std::to_string(port_) + "/");
    EXPECT_TRUE(LogInPage(*browser, user)) << browser->Text();
    for (const char* robot : kRobots) {
      EXPECT_TRUE(WaitForRow(*browser, robot, "Available")) << browser->Text();
    }
    return browser;
  }
  static std::string Card(const std::string& robot) {
    return "//article[@aria-label='" + robot + "']";
  }
  static bool WaitForRow(Browser& browser, const std::string& robot, const std::string& text) {
    return WaitForTextIn(browser, "#robot-" + robot, text);
  }
  // Once it is the one that is chosen.
  static bool WaitForCard(Browser& browser, const std::string& robot, const std::string& text) {
    (void)browser.Run("window.location.hash = 'fleet/" + robot + "'");
    return WaitForTextIn(browser, "article[aria-label=" + robot + "]", text);
  }
  static bool WaitForTextIn(Browser& browser, const std::string& selector,
                            const std::string& text) {
    return WaitUntil([&] {
      const json shown =
          browser.Run("return document.querySelector('" + selector + "')?.innerText ?? ''");
      return shown.is_string() && shown.get<std::string>().find(text) != std::string::npos;
    });
  }
  // Pixels from the left of the three on their lines; of one that is not drawn, below 0.
  static std::array<double, 3> DrawnAt(Browser& browser) {
    const json at = browser.Run(
        "return [1, 2, 3].map((n) => document.querySelector(`.lines [data-robot=robot${n}] circle`)"
        "?.getBoundingClientRect().left ?? -1)");
    return at.is_array() ? at.get<std::array<double, 3>>() : std::array<double, 3>{-1, -1, -1};
  }
  // On this page all three are seen to move.
  static bool AllMove(Browser& browser) {
    std::array<double, 3> from{-1, -1, -1};
    return WaitUntil([&] {
      const std::array<double, 3> at = DrawnAt(browser);
      bool all = true;
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (from[i] < 0) from[i] = at[i];
        all = all && from[i] >= 0 && at[i] > from[i] + 3;
      }
      return all;
    });
  }
  bool GoesOn(const std::string& robot) {
    const double from_m = Along_m(robot + ".csv");
    return WaitUntil([&] { return std::abs(Along_m(robot + ".csv") - from_m) > 0.05; });
  }

  std::vector<std::unique_ptr<Process>> simulated_;
  std::vector<std::unique_ptr<Process>> agents_;
};

TEST_F(ConsolePeopleTest, AnOperatorPausesOneOfThreeRobotsAndWhoLooksSeesIt) {
  const auto anna = Opened("anna", 1280, 1000);
  const auto guest = Opened("guest", 390, 844);
  const auto annas = As("anna");
  for (std::size_t i = 0; i < kRobots.size(); ++i) {
    const Replied sent = Post(std::string("/api/robots/") + kRobots[i] + "/missions", annas,
                              {{"orders", std::string("follow ") + kRoutes[i]}});
    ASSERT_EQ(sent.status, 200) << sent.body.dump();
  }
  ASSERT_TRUE(AllMove(*anna)) << anna->Text() << agents_[0]->output();
  ASSERT_TRUE(AllMove(*guest)) << guest->Text();
  anna->Screenshot(Shot("three-driving"));

  ASSERT_TRUE(anna->Click("//a[contains(., 'robot2')]")) << anna->Text();
  ASSERT_TRUE(anna->Click(Card("robot2") + "//button[. = 'Pause']")) << anna->Text();
  const auto clicked = steady_clock::now();
  ASSERT_TRUE(WaitForRow(*guest, "robot2", "Paused")) << guest->Text();
  std::printf("who looks saw the pause within %.0f ms\n",
              std::chrono::duration<double, std::milli>(steady_clock::now() - clicked).count());
  EXPECT_TRUE(WaitForCard(*guest, "robot2", "paused by console")) << guest->Text();
  EXPECT_TRUE(WaitForCard(*guest, "robot2", "anna")) << "who it was";
  EXPECT_TRUE(Stands("robot2.csv"));
  const double paused_at_m = Along_m("robot2.csv");
  EXPECT_TRUE(GoesOn("robot1")) << agents_[0]->output();
  EXPECT_TRUE(GoesOn("robot3")) << agents_[2]->output();
  EXPECT_NEAR(Along_m("robot2.csv"), paused_at_m, 0.01);
  anna->Screenshot(Shot("one-paused"));
  guest->Screenshot(Shot("phone-one-paused"));

  // A user who only looks finds nothing to press that acts, and the console refuses what they send.
  for (const std::string page : {"fleet", "cameras", "network", "routes", "history"}) {
    (void)guest->Run("window.location.hash = '" + page + "'");
    ASSERT_TRUE(WaitUntil([&] {
      return guest->Run("return document.querySelector('nav [aria-current]').hash") ==
                 json("#" + page) &&
             guest->Text().find("Loading …") == std::string::npos;
    })) << guest->Text();
    const json buttons =
        guest->Run("return [...document.querySelectorAll('button')].map((each) => each.innerText)");
    EXPECT_THAT(buttons.get<std::vector<std::string>>(),
                Each(testing::AnyOf("Camera", "Log out", "Search", "More", "Find a path", "−", "+",
                                    "hall", "bench", "back", HasSubstr("Commands"),
                                    HasSubstr("Copy "), StartsWith("All "), StartsWith("Moving "),
                                    StartsWith("Needs attention "), HasSubstr("follow "))))
        << page;
    EXPECT_THAT(guest->Text(), Not(HasSubstr("Upload"))) << page;
  }
  const auto guests = As("guest");
  for (const char* path :
       {"/api/all/stop", "/api/robots/robot1/stop", "/api/robots/robot1/pause",
        "/api/robots/robot2/resume", "/api/robots/robot1/missions", "/api/robots/robot1/drive",
        "/api/routes/hall/edits", "/api/transfers/uploads"}) {
    EXPECT_EQ(Post(path, guests).status, 403) << path;
  }
  EXPECT_TRUE(GoesOn("robot1"));

  ASSERT_TRUE(anna->Click(Card("robot2") + "//button[. = 'Resume']")) << anna->Text();
  (void)guest->Run("window.location.hash = 'fleet'");
  EXPECT_TRUE(WaitForRow(*guest, "robot2", "Driving")) << guest->Text();
  EXPECT_TRUE(GoesOn("robot2")) << agents_[1]->output();

  // A stop needs no server.
  server_->Signal(SIGKILL);
  (void)End(*server_);
  for (Browser* browser : {anna.get(), guest.get()}) {
    EXPECT_TRUE(browser->WaitForText("Route server offline")) << browser->Text();
  }
  anna->Screenshot(Shot("server-lost"));
  ASSERT_TRUE(anna->Click(Card("robot2") + "//button[contains(@class, 'stop')]"));
  EXPECT_TRUE(WaitForRow(*guest, "robot2", "Stopped")) << guest->Text();
  EXPECT_TRUE(Stands("robot2.csv"));
  console_->Signal(SIGKILL);
  for (Browser* browser : {anna.get(), guest.get()}) {
    EXPECT_TRUE(browser->WaitForText("Connection lost: Stop will not reach robots"))
        << browser->Text();
    EXPECT_TRUE(WaitForRow(*browser, "robot1", "Last: Driving")) << browser->Text();
    EXPECT_TRUE(WaitForCard(*browser, "robot1", "Last: Driving")) << browser->Text();
    EXPECT_TRUE(WaitForCard(*browser, "robot1", "data below is stale")) << browser->Text();
    (void)browser->Run("window.scrollTo(0, document.body.scrollHeight)");
    EXPECT_EQ(
        browser->Run("const at = document.querySelector('.pinned .banner')"
                     ".getBoundingClientRect(); return at.top >= 0 && at.bottom <= innerHeight"),
        json(true))
        << "wherever one has scrolled to";
  }
  EXPECT_TRUE(WaitForCard(*anna, "robot1", "will not arrive")) << "its Stop";
  EXPECT_THAT(anna->Text(), HasSubstr("Stop all\nwill not arrive"));
}

}  // namespace
}  // namespace trailcast::test
