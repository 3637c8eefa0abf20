// The console's page of schedules, in Chromium.
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ConsoleSchedulesTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    server_ = Server();
    StartConsole();
    browser_ = std::make_unique<Browser>(folder_ / "");
    ASSERT_TRUE(browser_->runs()) << browser_->log();
  }
  bool Click(const std::string& button) {
    return browser_->Click("//button[@aria-label='" + button + "' or . = '" + button + "']");
  }
  json Listed() { return Get("/api/schedules").value("schedules", json::array()); }

  std::unique_ptr<Browser> browser_;
};

TEST_F(ConsoleSchedulesTest, APersonSeesPausesAndRemovesThem) {
  browser_->Look(1200, 800);
  browser_->Open(Page() + "#schedules");
  ASSERT_TRUE(browser_->WaitForText("No robot is sent at set times")) << browser_->Text();
  const Replied added = Post(
      "/api/schedules",
      {{"words", "night-round to robot1 at 22:00 on mon-fri zone Europe/Berlin do follow hall"}});
  ASSERT_EQ(added.status, 200) << added.body;
  ASSERT_TRUE(browser_->WaitForText("at 22:00 on mon-fri, Europe/Berlin")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), HasSubstr("Not yet due"));
  EXPECT_THAT(browser_->Text(), HasSubstr(" 22:00 CE")) << "in its own time zone";
  browser_->Screenshot(Shot("desk-schedules"));
  ASSERT_TRUE(Click("Pause night-round"));
  ASSERT_TRUE(browser_->WaitForText("Paused by ")) << browser_->Text();
  ASSERT_TRUE(Click("Resume night-round"));
  ASSERT_TRUE(browser_->WaitForText(" 22:00 CE")) << browser_->Text();
  EXPECT_EQ(Listed().at(0)["paused_by"], nullptr);
  browser_->Look(390, 844);
  browser_->Screenshot(Shot("phone-schedules"));
  ASSERT_TRUE(Click("Remove night-round …"));
  ASSERT_TRUE(browser_->WaitForText("Keep it")) << "it asks first";
  EXPECT_EQ(Listed().size(), 1U);
  ASSERT_TRUE(Click("Remove night-round"));
  ASSERT_TRUE(browser_->WaitForText("No robot is sent at set times")) << browser_->Text();
  EXPECT_EQ(Listed(), json::array());
}

TEST_F(ConsoleSchedulesTest, WhatCannotBeDoneIsSaid) {
  browser_->Open(Page() + "#schedules");
  ASSERT_EQ(Post("/api/schedules", {{"words", "round to robot1 at 22:00 zone UTC do follow hall"}})
                .status,
            200);
  ASSERT_TRUE(browser_->WaitForText("at 22:00, UTC")) << browser_->Text();
  browser_->Block({"*/api/schedules/*"});
  ASSERT_TRUE(Click("Pause round"));
  ASSERT_TRUE(browser_->WaitForText("The console does not answer")) << browser_->Text();
}

}  // namespace
}  // namespace trailcast::test
