// The console's page of photos, in Chromium.
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/await.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ConsolePhotosTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    Teach();
    most_mps_ = kUnwatched_mps;
    server_ = Server();
    ASSERT_TRUE(Publish());
    StartConsole();
    PutOnDuty();
    browser_ = std::make_unique<Browser>(folder_ / "");
    ASSERT_TRUE(browser_->runs()) << browser_->log();
  }
  bool Photographed(const std::string& mission) {
    return WaitUntil([&] {
      return Get("/api/photos?mission=" + mission).value("photos", json::array()).size() == 1;
    });
  }

  std::unique_ptr<Browser> browser_;
};

TEST_F(ConsolePhotosTest, APersonSeesThisVisitBesideTheLastOne) {
  browser_->Look(1200, 900);
  browser_->Open(Page() + "#history/photos");
  ASSERT_TRUE(browser_->WaitForText("There are no photos")) << browser_->Text();
  ASSERT_EQ(
      Post("/api/robots/robot1/missions",
           {{"orders", "follow hall ..2"}, {"id", "first"}, {"photo_at", json::array({"hall@1"})}})
          .status,
      200);
  ASSERT_TRUE(Photographed("first")) << agent_->output();
  ASSERT_TRUE(WaitForState("available")) << Robot1();
  ASSERT_EQ(Post("/api/robots/robot1/missions", {{"orders", "follow hall backwards ..0.5"},
                                                 {"id", "second"},
                                                 {"photo_at", json::array({"hall@1"})}})
                .status,
            200);
  ASSERT_TRUE(Photographed("second")) << agent_->output();
  browser_->Open(Page() + "#history/photos-second");
  ASSERT_TRUE(browser_->WaitForText("Download as folder")) << browser_->Text();
  browser_->Screenshot(Shot("desk-photos"));
  ASSERT_TRUE(browser_->Click("//a[.//img]"));
  ASSERT_TRUE(browser_->WaitForText("Other visits")) << browser_->Text();
  ASSERT_TRUE(browser_->WaitForText("No change was found")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), HasSubstr("as this camera stood"));
  browser_->Screenshot(Shot("desk-photo"));
  browser_->Look(390, 844);
  browser_->Screenshot(Shot("phone-photo"));
}

}  // namespace
}  // namespace trailcast::test
