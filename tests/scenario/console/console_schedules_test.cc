// The console's page of schedules, in Chromium.
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kDelete = "\uE017";

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
  // Replaces what a field has. The first key selects all of it.
  bool Fill(const std::string& label, const std::string& text) {
    return browser_->Type("//label[starts-with(., '" + label + "')]/input", "\uE009a\uE000" + text);
  }
  bool Tick(const std::string& label) {
    return browser_->Click("//label[. = '" + label + "']/input");
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

TEST_F(ConsoleSchedulesTest, APersonMakesOneAndChangesItAndSeesWhenItIsDue) {
  browser_->Look(1200, 1000);
  browser_->Open(Page() + "#schedules");
  ASSERT_TRUE(Click("New schedule …")) << browser_->Text();
  ASSERT_TRUE(browser_->WaitForText("Fill in a name, robots and orders.")) << browser_->Text();
  ASSERT_TRUE(Fill("Name", "night-round"));
  ASSERT_TRUE(Fill("Robots", "robot1, cart-*"));
  ASSERT_TRUE(Fill("Orders", "follow hall"));
  ASSERT_TRUE(Fill("A photo every", "5"));
  ASSERT_TRUE(Fill("Photos at", "hall@3, hall@12.5"));
  ASSERT_TRUE(Fill("Times", "22:00, 26:00"));
  ASSERT_TRUE(Fill("Time zone", "Europe/Berlin"));
  ASSERT_TRUE(browser_->WaitForText("⚠ '26:00'")) << browser_->Text();
  ASSERT_TRUE(Fill("Times", "22:00, 02:00"));
  ASSERT_TRUE(browser_->WaitForText("; and so on.")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), HasSubstr(" 22:00 CE"));
  ASSERT_TRUE(Tick("Sat"));
  ASSERT_TRUE(Tick("Sun"));
  ASSERT_TRUE(Fill("Battery at least", "40"));
  ASSERT_TRUE(Tick("Not while its route is closed"));
  browser_->Screenshot(Shot("desk-schedule-form"));
  ASSERT_TRUE(Click("Make it"));
  ASSERT_TRUE(browser_->WaitForText("at 02:00,22:00 on mon-fri, Europe/Berlin"))
      << browser_->Text();
  ASSERT_TRUE(browser_->WaitForText("Due in the next 28 days")) << browser_->Text();
  json made = Listed().at(0);
  EXPECT_EQ(made["words"],
            "night-round to robot1,cart-* at 02:00,22:00 on mon-fri zone Europe/Berlin battery 40 "
            "unless-closed do photo every 5 at hall@3 at hall@12.5 follow hall");
  browser_->Screenshot(Shot("desk-schedule-calendar"));

  ASSERT_TRUE(Click("Edit night-round …"));
  ASSERT_TRUE(browser_->WaitForText("Change night-round")) << browser_->Text();
  ASSERT_TRUE(Tick("Every so often"));
  ASSERT_TRUE(Fill("Minutes between", "90"));
  ASSERT_TRUE(Fill("A photo every", kDelete));
  ASSERT_TRUE(Fill("Photos at", "hall@3"));
  ASSERT_TRUE(Tick("Only if the last one arrived"));
  browser_->Look(390, 844);
  browser_->Screenshot(Shot("phone-schedule-form"));
  ASSERT_TRUE(Click("Change it"));
  ASSERT_TRUE(browser_->WaitForText("every 90 on mon-fri, Europe/Berlin")) << browser_->Text();
  made = Listed().at(0);
  EXPECT_EQ(made["words"],
            "night-round to robot1,cart-* every 90 on mon-fri zone Europe/Berlin battery 40 "
            "unless-closed if-arrived do photo at hall@3 follow hall");
  browser_->Screenshot(Shot("phone-schedule-calendar"));
  ASSERT_TRUE(Click("Pause night-round"));
  ASSERT_TRUE(browser_->WaitForText("Nothing is due in the next 28 days")) << browser_->Text();
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
