// These test robots that are sent to teach, driven from afar, ended, and followed by others.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class TeachMissionTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    server_ = Server();
    robot_ = Robot("robot1", With({"--sim-truth", Path("truth.csv")}, stands_there_));
    agent_ = Serve("robot1", "duty", senses_);
    ASSERT_TRUE(agent_->WaitForOutput("available as 'robot1'")) << agent_->output();
    StartConsole();
    ASSERT_TRUE(WaitForState("available"));
  }
  // Returns the state of the mission of this name.
  std::string Became(const std::string& mission) {
    const json missions = Get("/api/missions?mission=" + mission);
    if (!missions.is_object() || missions["missions"].empty()) return "";
    const json& last = missions["missions"][0];
    return last["state"].get<std::string>() + ": " + last["detail"].get<std::string>();
  }
  bool WaitForEnd(const std::string& mission, const std::string& state) {
    return WaitUntil([&] { return Became(mission).starts_with(state); });
  }
  void SendToTeach(const std::string& orders, const std::string& id) {
    const Replied sent = Post("/api/robots/robot1/missions", {{"orders", orders}, {"id", id}});
    ASSERT_EQ(sent.status, 200) << sent.body.dump();
    ASSERT_TRUE(WaitUntil([&] { return Robot1().value("teaches", false); })) << agent_->output();
  }
  // A word as a person's page says one ten times a second.
  Replied Say(double linear_mps, double turn_radps = 0.0, const std::string& driver = "ann") {
    const auto now = steady_clock::now().time_since_epoch();
    return Post("/api/robots/robot1/drive",
                {{"linear_mps", linear_mps},
                 {"turn_radps", turn_radps},
                 {"driver", driver},
                 {"said_ms", std::chrono::duration_cast<milliseconds>(now).count()}});
  }
  // Drives as far east as that. Returns false if the robot does not get there.
  bool DriveTo(double along_m) {
    return WaitUntil([&] {
      const auto before = steady_clock::now();
      EXPECT_EQ(Say(0.4).status, 200);
      const auto took = std::chrono::duration<double, std::milli>(steady_clock::now() - before);
      longest_word_ms_ = std::max(longest_word_ms_, took.count());
      std::this_thread::sleep_for(milliseconds(60));
      return Along_m("truth.csv") >= along_m;
    });
  }
  // The robot's time in its truth, and how far east it is.
  std::vector<std::array<double, 2>> Truth() {
    std::vector<std::array<double, 2>> rows;
    std::ifstream in(Path("truth.csv"));
    for (std::string line; std::getline(in, line) && !in.eof();) {
      const auto comma = line.find(',');
      if (line[0] == 't' || comma == std::string::npos) continue;
      rows.push_back({std::stod(line), std::stod(line.substr(comma + 1))});
    }
    return rows;
  }
  // When its wheels last turned.
  double StoodSince_s() {
    const auto rows = Truth();
    double since_s = rows.front()[0];
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (std::abs(rows[i][1] - rows[i - 1][1]) > 2e-4) since_s = rows[i][0];
    }
    return since_s;
  }
  // For the last half second of its truth.
  bool Stood() {
    const auto rows = Truth();
    return !rows.empty() && rows.back()[0] - StoodSince_s() > 0.5;
  }
  Ended Tool(const Words& words) {
    return End(*Start("trailcast", words, "tool" + std::to_string(++tools_)));
  }

  Words stands_there_;  // options of the robot
  Words senses_;        // of its agent
  int tools_ = 0;
  double longest_word_ms_ = 0.0;
};

TEST_F(TeachMissionTest, WhatAPersonDrivesFromAfarIsFollowedByAnother) {
  SendToTeach("teach yard wet", "lesson");
  constexpr double kSoon_s = 1.5;  // 0.3 s without a word, and a base's braking
  // A machine that stands for a moment may spoil a try.
  double soonest_s = std::numeric_limits<double>::infinity();
  for (int time = 0; time < 3 && soonest_s > kSoon_s; ++time) {
    ASSERT_TRUE(DriveTo(2.5 + 0.4 * time)) << agent_->output();
    EXPECT_EQ(Say(-1.0, 0.0, "bob").status, 409) << "ann drives";
    const double silent_s = Truth().back()[0];
    ASSERT_TRUE(Stands("truth.csv"));
    soonest_s = std::min(soonest_s, StoodSince_s() - silent_s);
  }
  RecordProperty("stood_after_s", std::to_string(soonest_s));
  RecordProperty("longest_word_ms", std::to_string(longest_word_ms_));
  EXPECT_LE(soonest_s, kSoon_s);
  EXPECT_TRUE(Robot1().value("teaches", false)) << "it goes on";

  ASSERT_TRUE(DriveTo(4.0)) << agent_->output();
  ASSERT_TRUE(Stands("truth.csv"));
  const double end_m = Along_m("truth.csv");
  const Replied ended = Post("/api/robots/robot1/end");
  EXPECT_EQ(ended.status, 200) << ended.body.dump();
  ASSERT_TRUE(WaitForEnd("lesson", "arrived")) << Became("lesson") << agent_->output();
  EXPECT_THAT(Became("lesson"),
              AllOf(HasSubstr("taught route 'yard'"), HasSubstr("a server has it")));
  const json routes = Get("/api/routes?name=yard");
  ASSERT_EQ(routes["routes"].size(), 1U) << routes.dump();
  EXPECT_EQ(routes["routes"][0]["state"], "active");
  EXPECT_EQ(routes["routes"][0]["tags"], json({"wet"}));
  EXPECT_NEAR(routes["routes"][0]["length_m"].get<double>(), end_m - 1.0, 0.3);
  EXPECT_EQ(Post("/api/robots/robot1/end").status, 409) << "it teaches no route";

  robot_->Signal(SIGTERM);
  const auto other = Robot("robot2", {"--sim-truth", Path("truth2.csv")});
  const auto follower = Agent(
      With({"serve", "--store", Path("robot2.db"), "--name", "robot2"}, Drives("robot2")), "duty2");
  ASSERT_TRUE(follower->WaitForOutput("available as 'robot2'")) << follower->output();
  const Ended followed = Tool({"send", "robot2", "follow", "yard", "--wait"});
  EXPECT_EQ(followed.status, 0) << followed.output << follower->output();
  EXPECT_NEAR(Along_m("truth2.csv"), end_m, 0.3);
}

TEST_F(TeachMissionTest, AHeldRobotStandsAndWhatIsCancelledIsFollowedByNobody) {
  SendToTeach("teach yard", "lesson");
  ASSERT_TRUE(DriveTo(2.2)) << agent_->output();
  const Replied paused = Post("/api/robots/robot1/pause");
  EXPECT_EQ(paused.status, 200) << paused.body.dump();
  ASSERT_TRUE(WaitForState("paused"));
  EXPECT_TRUE(Robot1().value("teaches", false));
  ASSERT_TRUE(Stands("truth.csv"));
  const double at_m = Along_m("truth.csv");
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(Say(0.4).status, 200);
    std::this_thread::sleep_for(milliseconds(60));
  }
  EXPECT_NEAR(Along_m("truth.csv"), at_m, 0.02);
  EXPECT_EQ(Tool({"resume", "robot1"}).status, 0);
  ASSERT_TRUE(DriveTo(at_m + 0.5)) << agent_->output();
  EXPECT_EQ(Tool({"cancel", "robot1"}).status, 0);
  ASSERT_TRUE(WaitForEnd("lesson", "cancelled")) << Became("lesson") << agent_->output();
  EXPECT_THAT(Became("lesson"), HasSubstr("discarded"));
  EXPECT_TRUE(Get("/api/routes?name=yard&state=active")["routes"].empty());
  EXPECT_EQ(Tool({"end", "robot1"}).status, 1) << "it teaches no route";
}

TEST_F(TeachMissionTest, AfterARestartTheTeachingHasFailedAndNothingMoves) {
  SendToTeach("teach yard", "lesson");
  ASSERT_TRUE(DriveTo(2.2)) << agent_->output();
  agent_->Signal(SIGKILL);
  (void)End(*agent_);
  ASSERT_TRUE(Stands("truth.csv"));
  const double at_m = Along_m("truth.csv");
  agent_ = Serve("robot1", "duty2");
  ASSERT_TRUE(WaitForEnd("lesson", "failed")) << Became("lesson") << agent_->output();
  EXPECT_THAT(Became("lesson"), HasSubstr("has started again in the middle"));
  EXPECT_NEAR(Along_m("truth.csv"), at_m, 0.02);
  EXPECT_TRUE(Get("/api/routes?name=yard&state=active")["routes"].empty());
}

// A pillar on its way, and a scanner that sees it.
class TeachBeforeAPillarTest : public TeachMissionTest {
 protected:
  TeachBeforeAPillarTest() {
    stands_there_ = {"--obstacle", "3,1.5,0.2@0"};
    senses_ = {"--scan-topic", "scan", "--robot-width", "0.4"};
  }
};

TEST_F(TeachBeforeAPillarTest, WhoIsDrivenByHandStandsBeforeItAndIsDrivenAway) {
  SendToTeach("teach yard", "lesson");
  const auto says = [&] { return Robot1().value("detail", ""); };
  // A word in time, whatever came of the one before.
  const auto drive_until = [&](double linear_mps, double turn_radps, const auto& done) {
    return WaitUntil([&] {
      EXPECT_EQ(Say(linear_mps, turn_radps).status, 200);
      std::this_thread::sleep_for(milliseconds(60));
      return done();
    });
  };
  ASSERT_TRUE(
      drive_until(0.4, 0.0, [&] { return says().starts_with("something stands 0.") && Stood(); }))
      << says() << agent_->output();
  const double stood_m = Along_m("truth.csv");
  // Its front is 0.2 m ahead of its axle, the pillar's near side at 2.8 m.
  EXPECT_LE(stood_m, 2.8 - 0.2 - 0.2);
  EXPECT_GT(stood_m, 2.8 - 0.2 - 0.5);
  EXPECT_TRUE(Robot1().value("teaches", false));
  ASSERT_TRUE(drive_until(-0.2, 0.0,
                          [&] { return Along_m("truth.csv") < stood_m - 0.2 && says().empty(); }))
      << says() << agent_->output();
  EXPECT_EQ(Tool({"cancel", "robot1"}).status, 0);
  EXPECT_TRUE(WaitForEnd("lesson", "cancelled")) << Became("lesson");
}

TEST_F(TeachMissionTest, APersonTeachesFromTheConsolesPage) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("Available")) << browser.Text();
  ASSERT_TRUE(browser.Click("//button[contains(., 'Teach')]"));
  ASSERT_TRUE(browser.Type("//label[contains(., 'Name')]/input", "yard"));
  ASSERT_TRUE(browser.Type("//label[contains(., 'Tags')]/input", "wet, a/b"));
  ASSERT_TRUE(browser.WaitForText("cannot be a tag")) << browser.Text();
  ASSERT_TRUE(browser.Type("//label[contains(., 'Tags')]/input", "\xEE\x80\x83\xEE\x80\x83"));
  ASSERT_TRUE(browser.WaitForText("Slide to have robot1 teach yard")) << browser.Text();
  browser.Screenshot(Shot("phone-teach"));
  ASSERT_TRUE(browser.Type("//input[@type='range']", kSlide));
  ASSERT_TRUE(browser.WaitForText("Features in view")) << browser.Text() << agent_->output();

  ASSERT_TRUE(browser.Click("//div[@role='application']"));
  ASSERT_TRUE(WaitUntil([&] {
    EXPECT_TRUE(browser.HoldKey("w", 1000));
    return Along_m("truth.csv") > 2.2;
  })) << browser.Text();
  browser.Screenshot(Shot("phone-driving"));
  browser.Look(1280, 800, true);
  browser.Screenshot(Shot("desktop-teaching"));
  EXPECT_TRUE(Stands("truth.csv")) << "the key is let go";
  ASSERT_TRUE(browser.Click("//button[contains(., 'End')]"));
  ASSERT_TRUE(browser.WaitForText("a server has it")) << browser.Text() << agent_->output();
  EXPECT_THAT(browser.Text(), Not(HasSubstr("Features in view")));
}

}  // namespace
}  // namespace trailcast::test
