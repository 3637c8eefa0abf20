// The console's drawing of the network, in Chromium.
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class ConsoleNetworkTest : public ConsoleFleetTest {
 protected:
  json Network() { return Get("/api/network").value("network", json::object()); }
  static std::string Mode(const std::string& name) {
    return "//label[normalize-space(.) = '" + name + "']/input";
  }
  static std::string Field(const std::string& label) {
    return "//*[@class='net-fields']/label[starts-with(normalize-space(.), '" + label + "')]/input";
  }
  static std::string Button(const std::string& label) {
    return "//*[@class='net-fields']/button[. = '" + label + "']";
  }
  static bool HasClosed(Browser& browser, int count) {
    return WaitUntil([&] {
      return browser.Run("return document.querySelectorAll('.net-lines .closed').length") ==
             json(count);
    });
  }
};

// The office was taught along the hall, which the server may have noticed, too.
TEST_F(ConsoleNetworkTest, RoutesAreJoinedClosedAndARobotIsSentToAPlaceUponThem) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Teach();
  Teach("routes.db", kPath, "office");
  server_ = Server();
  ASSERT_TRUE(Publish());
  ASSERT_NO_FATAL_FAILURE(PutOnDuty({"--sim-truth", Path("truth.csv")}));
  StartConsole();
  ASSERT_TRUE(WaitForState("available"));
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(1280, 1200);
  browser.Open(Page() + "#network");

  ASSERT_TRUE(browser.Click(Mode("Join")));
  ASSERT_TRUE(browser.Type(Field("From"), "hall@1.5"));
  ASSERT_TRUE(browser.Type(Field("To"), "office@1.5"));
  ASSERT_TRUE(browser.Click(Button("Join")));
  ASSERT_TRUE(browser.WaitForText("Now: join hall@1.5 office@1.5")) << browser.Text();
  ASSERT_TRUE(browser.WaitForText("2 routes, 1 junction.")) << browser.Text();
  ASSERT_EQ(Network()["joints"].size(), 1U);

  browser.Open(Page() + "#routes/office");
  ASSERT_TRUE(browser.WaitForText("At 1.5 m hall, there at 1.5 m: joined, from there"))
      << browser.Text();
  browser.Screenshot(Shot("passing"));
  ASSERT_TRUE(browser.Click("//section[@aria-label='Which routes pass here']//a[. = 'hall']"));
  ASSERT_TRUE(browser.WaitForText("At 1.5 m office, there at 1.5 m: joined, to there"))
      << browser.Text();
  ASSERT_TRUE(browser.Click("//nav/a[. = 'Network']"));
  ASSERT_TRUE(browser.WaitForText("2 routes, 1 junction.")) << browser.Text();

  // A click upon a route says which place is meant.
  ASSERT_TRUE(browser.Click(Mode("Name a place")));
  (void)browser.Run(
      "const svg = document.querySelector('.net-lines svg');"
      "const box = svg.getBoundingClientRect();"
      "svg.dispatchEvent(new MouseEvent('click', {bubbles: true, clientX: box.left + box.width / "
      "2, clientY: box.top + 0.75 * box.height}))");
  ASSERT_TRUE(WaitUntil([&] {
    const json place = browser.Run("return document.querySelector('.net-fields input').value");
    return place.is_string() && place.get<std::string>().starts_with("office@");
  })) << browser.Text();
  ASSERT_TRUE(browser.Type(Field("Is called"), "bay"));
  ASSERT_TRUE(browser.Click(Button("Name it")));
  ASSERT_TRUE(browser.WaitForText("Now: name bay office@")) << browser.Text();
  // While the page asks anew, others are told what was so before.
  ASSERT_TRUE(WaitUntil([&] { return !Network()["names"].empty(); })) << Network();
  const double bay_m = Network()["names"][0]["place"]["along_m"];
  ASSERT_GT(bay_m, 1.6);
  ASSERT_LT(bay_m, 3.0);

  ASSERT_TRUE(browser.Click(Mode("Close, open, limit")));
  ASSERT_TRUE(browser.Type(Field("Route"), "office"));
  ASSERT_TRUE(browser.Type(Field("From"), "1.55"));
  ASSERT_TRUE(browser.Type(Field("To"), "1.6"));
  ASSERT_TRUE(browser.Click(Button("Close")));
  ASSERT_TRUE(browser.WaitForText("Now: close office 1.55..1.6")) << browser.Text();
  ASSERT_TRUE(HasClosed(browser, 1)) << browser.Text();
  EXPECT_EQ(Network()["closed"].size(), 1U);

  ASSERT_TRUE(browser.Click(Mode("Find a path")));
  ASSERT_TRUE(browser.Type(Field("From"), "hall@1"));
  ASSERT_TRUE(browser.Type(Field("To"), "office@1.55"));
  ASSERT_TRUE(browser.Click(Button("Find a path")));
  ASSERT_TRUE(
      browser.WaitForText("0.55 m to office@1.55: hall 1 to 1.5 m, then office 1.5 to 1.55 m"))
      << browser.Text();
  const json drawn = browser.Run("return document.querySelector('.on-way').getAttribute('d')");
  EXPECT_THAT(drawn.get<std::string>(), Not(IsEmpty()));
  // The page tells of the places in the fields.
  ASSERT_TRUE(browser.Type(Field("To"), "5"));
  ASSERT_TRUE(WaitUntil([&] { return browser.Text().find("0.55 m to") == std::string::npos; }))
      << browser.Text();

  ASSERT_TRUE(browser.Click(Mode("Send a robot")));
  ASSERT_TRUE(browser.Type(Field("To"), "den"));
  ASSERT_TRUE(browser.Click(Button("Show the path")));
  ASSERT_TRUE(browser.WaitForText("no place is called 'den'")) << browser.Text();
  EXPECT_THAT(browser.Text(), Not(HasSubstr("'trailcast"))) << "commands are of no use here";
  ASSERT_TRUE(browser.Type(Field("To"),
                           "\xEE\x80\x83\xEE\x80\x83\xEE\x80\x83"
                           "bay"));  // Backspace
  ASSERT_TRUE(browser.Type(Field("From"), "hall@0"));
  ASSERT_TRUE(browser.Click(Button("Show the path")));
  ASSERT_TRUE(browser.WaitForText("office 1.55..1.6")) << "why not: " << browser.Text();
  ASSERT_TRUE(browser.Click("//td//button[starts-with(., 'Open')]")) << browser.Text();
  ASSERT_TRUE(HasClosed(browser, 0)) << browser.Text();
  ASSERT_TRUE(browser.Click(Button("Show the path")));
  ASSERT_TRUE(browser.WaitForText("hall 0 to 1.5 m, then office 1.5 to")) << browser.Text();
  browser.Screenshot(Shot("network-way"));
  ASSERT_TRUE(browser.Type("//*[@class='net-way']//input[@type='range']", kSlide));
  // It stands on its way, to be seen there.
  ASSERT_TRUE(WaitUntil([&] { return Robot1().value("route_id", "") != ""; }))
      << browser.Text() << agent_->output();
  ASSERT_EQ(Post("/api/robots/robot1/pause").status, 200);
  ASSERT_TRUE(WaitUntil([&] {
    return browser.Run("return document.querySelectorAll('.net-lines .on-line').length") == json(1);
  })) << browser.Text();
  browser.Screenshot(Shot("network"));
  browser.Look(390, 844, true);
  browser.Screenshot(Shot("phone-network"));
  ASSERT_EQ(Post("/api/robots/robot1/resume").status, 200);
  ASSERT_TRUE(WaitUntil([&] {
    const json missions = State().value("missions", json::array());
    return !missions.empty() && missions[0].value("state", "") == "arrived";
  })) << State().dump()
      << agent_->output();
  EXPECT_NEAR(Along_m("truth.csv"), 1.0 + bay_m, 0.3);
}

}  // namespace
}  // namespace trailcast::test
