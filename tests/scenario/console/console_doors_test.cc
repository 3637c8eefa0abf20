// These test who may use the console: users over TLS, and not others.
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "tests/scenario/console/console_users.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ConsoleDoorsTest : public ConsoleUsersTest {
 protected:
  std::size_t ConsolesBytes() {
    std::ifstream statm("/proc/" + std::to_string(console_->pid()) + "/statm");
    std::size_t pages = 0;
    statm >> pages >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  }
};

TEST_F(ConsoleDoorsTest, EachMayWhatTheirRoleSays) {
  AddUser("anna", "operate");
  AddUser("guest", "look");
  const Ended program = Users({"add", "warehouse", "--role", "operate", "--token"});
  ASSERT_EQ(program.status, 0) << program.output;
  const std::string token = program.output.substr(program.output.size() - 65, 64);
  StartWithTls();

  EXPECT_EQ(Client()->Get("/")->status, 200);
  EXPECT_EQ(Get("/api/state").status, 401);
  EXPECT_EQ(Post("/api/all/stop").status, 401);
  const auto anna = As("anna");
  EXPECT_EQ(Get("/api/state", anna).status, 200);
  EXPECT_EQ(Post("/api/robots/robot1/stop", anna).status, 504) << "no robot is there";
  const auto guest = As("guest");
  EXPECT_EQ(Get("/api/state", guest).status, 200);
  const Replied refused = Post("/api/robots/robot1/stop", guest);
  EXPECT_EQ(refused.status, 403);
  EXPECT_EQ(refused.body["error"], "guest may not do this: that takes the role 'operate'");
  const httplib::Headers warehouse{{"Authorization", "Bearer " + token}};
  EXPECT_EQ(Get("/api/me", warehouse).body["user"], "warehouse");
  EXPECT_EQ(Post("/api/robots/robot1/stop", warehouse).status, 504);

  // Another page, that anna's browser shows.
  httplib::Headers theirs = anna;
  theirs.erase("Origin");
  EXPECT_EQ(Post("/api/robots/robot1/stop", theirs).status, 403);
  theirs.emplace("Origin", "https://evil.example");
  EXPECT_EQ(Post("/api/robots/robot1/stop", theirs).status, 403);
  // No page sends this by itself. A stop alone is obeyed whatever it comes with.
  const auto as_form = [&](const char* path) {
    return Client()->Post(path, anna, "reason=rain", "application/x-www-form-urlencoded")->status;
  };
  EXPECT_EQ(as_form("/api/robots/robot1/release"), 415);
  EXPECT_EQ(as_form("/api/robots/robot1/stop"), 504);

  const auto page = Client()->Get("/");
  EXPECT_THAT(page->get_header_value("Strict-Transport-Security"), HasSubstr("max-age="));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"),
              AllOf(HasSubstr("frame-ancestors 'none'"), HasSubstr("object-src 'none'")));
  EXPECT_THAT(page->get_header_value("Permissions-Policy"), HasSubstr("camera=()"));

  // A user who is removed is logged out, though the console runs on.
  ASSERT_EQ(Users({"remove", "anna"}).status, 0);
  const auto until = steady_clock::now() + test::kLongEnough;
  while (Get("/api/me", anna).status != 401) ASSERT_LT(steady_clock::now(), until);
  EXPECT_EQ(Get("/api/me", guest).status, 200);
  console_->Signal(SIGTERM);
  EXPECT_EQ(End(*console_).status, 0) << console_->output();
}

TEST_F(ConsoleDoorsTest, WhoGuessesPasswordsHoldsUpNobodyWhoIsIn) {
  AddUser("anna", "operate");
  StartWithTls();
  const auto anna = As("anna");
  ASSERT_EQ(Get("/api/me", anna).status, 200);
  std::atomic<bool> over{false};
  std::atomic<int> waits{0};
  std::vector<std::thread> strangers;
  for (int i = 0; i < 6; ++i) {
    strangers.emplace_back([&, i] {
      for (int n = 0; !over; ++n) {
        if (LogIn("name" + std::to_string(i), std::to_string(n)).status == 429) ++waits;
      }
    });
  }
  const auto until = steady_clock::now() + test::kLongEnough;
  std::vector<steady_clock::duration> took;
  while ((waits < 20 || took.size() < 20) && steady_clock::now() < until) {
    const auto began = steady_clock::now();
    EXPECT_EQ(Get("/api/me", anna).status, 200);
    took.push_back(steady_clock::now() - began);
  }
  over = true;
  for (std::thread& stranger : strangers) stranger.join();
  EXPECT_GE(waits, 20) << console_->output();
  // The longest is that of a machine that stands for a moment.
  std::sort(took.begin(), took.end());
  EXPECT_LT(took[took.size() / 2], std::chrono::seconds(5));
  std::printf("of %zu requests during guesses the longest took %.0f ms\n", took.size(),
              std::chrono::duration<double, std::milli>(took.back()).count());
  EXPECT_THAT(console_->output(), HasSubstr("a log-in from 127.0.0.1 was refused"));
  EXPECT_THAT(console_->output(), Not(HasSubstr("name1"))) << "may be a password";
}

TEST_F(ConsoleDoorsTest, EndlessRequestsOverTlsCostNextToNothing) {
  AddUser("anna", "operate");
  StartWithTls();
  ASSERT_EQ(Get("/api/me").status, 401);
  const std::size_t before = ConsolesBytes();
  constexpr std::size_t kTooMuch = 200U << 20U;
  std::size_t sent = 0;
  const std::string chunk(0x10000, 'x');
  auto client = Client();
  (void)client->Post(
      "/api/log-in",
      [&](std::size_t, httplib::DataSink& sink) {
        sent += chunk.size();
        return sent < kTooMuch && sink.write(chunk.data(), chunk.size());
      },
      "application/json");
  EXPECT_LT(sent, 16U << 20U);
  (void)Client()->Get("/" + std::string(16U << 20U, 'x'));
  (void)Post("/api/log-in", {}, {{"user", "anna"}, {"password", std::string(60'000, 'x')}});
  EXPECT_LT(ConsolesBytes(), before + (64U << 20U)) << "32 MB of these for the password";
  EXPECT_EQ(LogIn("anna", kPassword).status, 200);
}

TEST_F(ConsoleDoorsTest, WhatIsMissingToLetOthersInIsSaid) {
  const auto refused = [&](const Words& words) {
    return End(*Start("trailcast-console", With({"--http-port", "0"}, words), "console"));
  };
  const auto nobody = refused({"--http-host", "0.0.0.0"});
  EXPECT_EQ(nobody.status, 2);
  EXPECT_THAT(nobody.output, AllOf(HasSubstr("--users FILE"), HasSubstr("users add")));
  const auto no_file = refused({"--users", Path("users")});
  EXPECT_EQ(no_file.status, 1);
  EXPECT_THAT(no_file.output, HasSubstr("users add NAME"));
  AddUser("anna", "look");
  const auto open = refused({"--http-host", "0.0.0.0", "--users", Path("users")});
  EXPECT_EQ(open.status, 2);
  EXPECT_THAT(open.output, AllOf(HasSubstr("--tls-certificate"), HasSubstr("openssl req")));
  const auto half = refused({"--tls-key", files_.key.string()});
  EXPECT_EQ(half.status, 2);
  const auto no_key = refused({"--users", Path("users"), "--tls-certificate",
                               files_.certificate.string(), "--tls-key", Path("none")});
  EXPECT_EQ(no_key.status, 1);
  EXPECT_THAT(no_key.output, HasSubstr("the key in"));
  EXPECT_EQ(refused({"--behind-proxy"}).status, 2);
  ASSERT_EQ(Users({"remove", "anna"}).status, 0);
  EXPECT_EQ(refused({"--users", Path("users")}).status, 1) << "nobody could log in";
}

TEST_F(ConsoleDoorsTest, UsersAreAddedListedAndRemoved) {
  AddUser("anna", "operate");
  struct stat status {};
  ASSERT_EQ(stat(Path("users").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  EXPECT_THAT(Users({"add", "anna", "--role", "look"}).output, HasSubstr("already"));
  EXPECT_THAT(Users({"add", "bob", "--role", "look"}, "short").output, HasSubstr("10 to 256"));
  EXPECT_EQ(Users({"add", "bob", "--role", "root"}).status, 2);
  EXPECT_EQ(Users({"add", "b/b", "--role", "look"}).status, 2);
  EXPECT_EQ(Users({"add", "bob"}).status, 2);
  EXPECT_THAT(Users({"list"}).output, AllOf(HasSubstr("anna"), HasSubstr("operate")));
  EXPECT_EQ(Users({"passwd", "anna"}, "another horse").status, 0);
  EXPECT_EQ(Users({"passwd", "bob"}).status, 1);
  EXPECT_EQ(Users({"remove", "bob"}).status, 1);
  StartWithTls();
  EXPECT_EQ(LogIn("anna", kPassword).status, 401);
  EXPECT_EQ(LogIn("anna", "another horse").status, 200);
}

TEST_F(ConsoleDoorsTest, APersonLogsInStopsARobotAndLogsOutInABrowser) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  AddUser("anna", "operate");
  AddUser("guest", "look");
  Teach();
  const auto server = Server();
  const auto robot = Robot("robot1", {});
  const auto agent = Serve("robot1");
  ASSERT_TRUE(agent->WaitForOutput("available as 'robot1'")) << agent->output();
  StartConsole({"--users", Path("users")});
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("Log in to see the robots")) << browser.Text();
  EXPECT_THAT(browser.Text(), Not(HasSubstr("robot1")));
  ASSERT_TRUE(LogInPage(browser, "anna", "wrong horse"));
  ASSERT_TRUE(browser.WaitForText("Wrong user name or password")) << browser.Text();
  browser.Screenshot(Shot("phone-log-in"));
  browser.Look(1280, 800, true);
  browser.Screenshot(Shot("desktop-log-in"));
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(LogInPage(browser, "anna"));
  ASSERT_TRUE(browser.WaitForText("robot1")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("anna")) << browser.Text();
  EXPECT_EQ(browser.Run("return document.cookie"), "") << "no script reads the session";
  ASSERT_TRUE(browser.Click("//article//button[contains(@class, 'stop')]"));
  ASSERT_TRUE(browser.WaitForText("UTC: anna")) << browser.Text();
  browser.Screenshot(Shot("phone-logged-in"));

  ASSERT_TRUE(browser.Click("//button[. = 'Log out']"));
  ASSERT_TRUE(LogInPage(browser, "guest"));
  ASSERT_TRUE(browser.WaitForText("robot1")) << browser.Text();
  EXPECT_THAT(browser.Text(), HasSubstr("View only"));
  EXPECT_EQ(browser.Run("return document.querySelectorAll('button.stop').length"), 0);
  browser.Screenshot(Shot("phone-guest"));
  browser.Look(1280, 800);
  browser.Screenshot(Shot("desktop-guest"));
  // A user who is removed is asked to log in, without doing anything.
  ASSERT_EQ(Users({"remove", "guest"}).status, 0);
  EXPECT_TRUE(browser.WaitForText("Log in to see the robots")) << browser.Text();
}

}  // namespace
}  // namespace trailcast::test
