// The console's users on its page, in Chromium.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_users.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;

class ConsoleUsersPageTest : public ConsoleUsersTest {
 protected:
  static constexpr const char* kAnnasPassword = "nine lives and one more";

  static std::string Row(const std::string& user) {
    return "//tr[td[@data-label='User'][contains(., '" + user + "')]]";
  }
};

TEST_F(ConsoleUsersPageTest, AnAdministratorAddsChangesAndRemovesAUser) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  AddUser("boss", "administer");
  StartWithTls();
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open("https://localhost:" + std::to_string(port_) + "/");
  ASSERT_TRUE(LogInPage(browser, "boss")) << browser.Text();
  ASSERT_TRUE(browser.Click("//a[. = 'boss']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("boss (you)")) << browser.Text();

  EXPECT_EQ(LogIn("anna", kAnnasPassword).status, 401);
  ASSERT_TRUE(browser.Type("//form[@aria-label='Add a user']//input[@name='user']", "anna"));
  ASSERT_TRUE(
      browser.Type("//form[@aria-label='Add a user']//input[@name='password']", kAnnasPassword));
  ASSERT_TRUE(browser.Click("//button[. = 'Add']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("anna may operate.")) << browser.Text();
  EXPECT_TRUE(WaitUntil([&] { return LogIn("anna", kAnnasPassword).status == 200; }));
  browser.Screenshot(Shot("users"));
  browser.Look(390, 844, true);
  browser.Screenshot(Shot("phone-users"));

  ASSERT_TRUE(browser.Click(Row("anna") + "//option[@value='look']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("anna may look now.")) << browser.Text();
  EXPECT_TRUE(WaitUntil([&] { return LogIn("anna", kAnnasPassword).body["role"] == "look"; }));

  ASSERT_TRUE(browser.Click(Row("anna") + "//button[. = 'Remove']")) << browser.Text();
  ASSERT_TRUE(browser.Click(Row("anna") + "//button[. = 'Remove anna, really']")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("anna is removed")) << browser.Text();
  EXPECT_TRUE(WaitUntil([&] { return LogIn("anna", kAnnasPassword).status == 401; }));

  ASSERT_TRUE(browser.Click(Row("boss") + "//button[. = 'Remove']")) << browser.Text();
  ASSERT_TRUE(browser.Click(Row("boss") + "//button[. = 'Remove boss, really']")) << browser.Text();
  EXPECT_TRUE(browser.WaitForText("boss is the last")) << browser.Text();
}

TEST_F(ConsoleUsersPageTest, AnOperatorSeesNoUsers) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  AddUser("boss", "administer");
  AddUser("anna", "operate");
  StartWithTls();
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 800);
  browser.Open("https://localhost:" + std::to_string(port_) + "/#users");
  ASSERT_TRUE(LogInPage(browser, "anna")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("Only a user who may administer sees the users."))
      << browser.Text();
  EXPECT_EQ(browser.Run("return document.querySelector('a[href=\"#users\"]')"), json());
  EXPECT_EQ(Get("/api/users", As("anna")).status, 403);
}

}  // namespace
}  // namespace trailcast::test
