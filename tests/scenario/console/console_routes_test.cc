// The console's pages about routes and what has been, in Chromium.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"
#include "tests/support/await.h"
#include "tests/support/walk_frames.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ConsoleRoutesTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
    server_ = Server();
    StartConsole();
    browser_ = std::make_unique<Browser>(folder_ / "");
    ASSERT_TRUE(browser_->runs()) << browser_->log();
    browser_->Look(390, 844);
  }
  void Open(const std::string& page) { browser_->Open(Page() + "#" + page); }
  void Slide() { ASSERT_TRUE(browser_->Type("//input[@type='range']", kSlide)); }
  // Waits for the answer about a picture that was chosen.
  bool WaitForAnswer() {
    return WaitUntil([&] {
      const std::string text = browser_->Text();
      const bool none = text.find("No route looks like this") != text.npos;
      return none || text.find("segment ") != text.npos || text.find("⚠") != text.npos;
    });
  }

  std::unique_ptr<Browser> browser_;
};

TEST_F(ConsoleRoutesTest, WhatIsNotKnownYetIsNotSaidToBeAbsent) {
  server_->Signal(SIGSTOP);
  Open("fleet");
  ASSERT_TRUE(browser_->WaitForText("Loading missions")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), Not(HasSubstr("No robot was sent")));
  ASSERT_TRUE(browser_->WaitForText("No robot is heard")) << browser_->Text();
  server_->Signal(SIGCONT);
  ASSERT_TRUE(browser_->WaitForText("No robot was sent anywhere yet")) << browser_->Text();

  browser_->Block({"*/api/routes*"});
  ASSERT_TRUE(browser_->Click("//label[. = 'Shape']"));
  ASSERT_TRUE(browser_->WaitForText("Other routes are not listed")) << browser_->Text();
  browser_->Block({"*/api/me"});
  browser_->Open("about:blank");
  Open("fleet");
  ASSERT_TRUE(browser_->WaitForText("The console does not answer. This page asks again"))
      << browser_->Text();
  browser_->Block({});
  ASSERT_TRUE(browser_->WaitForText("No robot was sent anywhere yet")) << browser_->Text();
}

TEST_F(ConsoleRoutesTest, APersonFindsARouteAndChoosesItsRevision) {
  for (int revision = 1; revision <= 2; ++revision) {  // the first one is followed, until ..
    Teach();
    ASSERT_TRUE(Publish());
  }
  Open("routes");
  ASSERT_TRUE(browser_->WaitForText("2 of 2")) << browser_->Text();
  ASSERT_TRUE(browser_->Type("//input[@name='prefix']", "attic\xEE\x80\x87"));  // Enter
  ASSERT_TRUE(browser_->WaitForText("No routes match.")) << browser_->Text();
  browser_->Open("about:blank");
  Open("routes");
  ASSERT_TRUE(browser_->Type("//input[@name='prefix']", "ha\xEE\x80\x87"));
  ASSERT_TRUE(browser_->WaitForText("2 of 2")) << browser_->Text();
  browser_->Screenshot(Shot("phone-routes"));
  ASSERT_TRUE(browser_->Click("//a[text()='hall']"));
  ASSERT_TRUE(browser_->WaitForText("Segments")) << browser_->Text();
  EXPECT_THAT(browser_->Text(),
              AllOf(HasSubstr("Camera"), HasSubstr("scout"), Not(HasSubstr("Roll back"))))
      << "there is nothing to go back to";
  ASSERT_TRUE(browser_->Click("//th[contains(., 'Ground')]/button"));
  ASSERT_TRUE(browser_->WaitForText("slope not known")) << browser_->Text();
  browser_->Screenshot(Shot("phone-revisions"));

  ASSERT_TRUE(browser_->Click("(//button[contains(., 'Activate')])[1]"));
  ASSERT_TRUE(browser_->WaitForText("Slide to activate hall revision 2")) << browser_->Text();
  Slide();
  ASSERT_TRUE(browser_->WaitForText("revision 2 is active")) << browser_->Text();
  ASSERT_TRUE(browser_->Click("//button[contains(., 'Roll back')]"));
  ASSERT_TRUE(browser_->WaitForText("Slide to roll back hall")) << browser_->Text();
  browser_->Screenshot(Shot("phone-rollback"));
  Slide();
  ASSERT_TRUE(browser_->WaitForText("revision 1 is active")) << browser_->Text();
  ASSERT_TRUE(browser_->WaitForText("console: activated hall@1")) << browser_->Text();
  browser_->Look(1280, 800, true);
  ASSERT_TRUE(browser_->Click("(//button[text()='Download'])[1]"));
  ASSERT_TRUE(browser_->WaitForText("bytes, checked")) << browser_->Text();
  browser_->Screenshot(Shot("desktop-revisions"));

  ASSERT_EQ(
      End(*Start("trailcast", {"export", "hall@1", "--out", Path("hall.trailcast")}, "export"))
          .status,
      0);
  Open("routes");
  ASSERT_TRUE(browser_->WaitForText("Upload route")) << browser_->Text();
  ASSERT_TRUE(browser_->Type("//input[@accept='.trailcast']", Path("hall.trailcast")));
  ASSERT_TRUE(browser_->WaitForText("hall revision 1: was there already")) << browser_->Text();

  ASSERT_TRUE(browser_->Click("//a[text()='hall']"));
  ASSERT_TRUE(browser_->Click("//button[contains(., 'Rename')]"));
  ASSERT_TRUE(browser_->Type("//label[starts-with(., 'Name')]/input", "way 2"));
  ASSERT_TRUE(browser_->WaitForText("without spaces")) << browser_->Text();
  ASSERT_TRUE(browser_->Type("//label[starts-with(., 'Name')]/input",
                             "\xEE\x80\x83\xEE\x80\x83"));  // Backspace
  ASSERT_TRUE(browser_->Type("//label[starts-with(., 'Tags')]/input", " night wet"));
  ASSERT_TRUE(browser_->Type("//label[starts-with(., 'Description')]/input", "along the shelves"));
  ASSERT_TRUE(browser_->Click("//button[text()='Save']"));
  ASSERT_TRUE(browser_->WaitForText("Saved.")) << browser_->Text();
  const json renamed = Get("/api/routes?name=hallway")["routes"];
  ASSERT_EQ(renamed.size(), 2U) << renamed.dump();
  EXPECT_EQ(renamed[0]["tags"], json({"night", "wet"}));
  EXPECT_EQ(renamed[1]["description"], "along the shelves");
  EXPECT_TRUE(browser_->WaitForText("hallway")) << browser_->Text();
}

TEST_F(ConsoleRoutesTest, APersonSeesWhatWasChangedSinceWhenAndByWhom) {
  Teach();
  ASSERT_TRUE(Publish());
  for (const Words& words :
       {Words{"routes", "rename", "hall", "aisle"}, Words{"network", "close", "aisle", "1..2"}}) {
    const Ended done = End(*Start("trailcast", With({"--name", "night-shift"}, words), "tool"));
    ASSERT_EQ(done.status, 0) << done.output;
  }
  Open("routes");
  ASSERT_TRUE(browser_->Click("//a[. = 'Activity log']"));
  ASSERT_TRUE(browser_->WaitForText("3 changes since ")) << browser_->Text();
  EXPECT_THAT(browser_->Text(),
              AllOf(HasSubstr("close aisle 1..2"), HasSubstr("night-shift"),
                    HasSubstr("renamed hall to aisle"), HasSubstr("stored hall@1, 3.5 m, active"),
                    HasSubstr("scout"), HasSubstr("The server keeps it since ")));
  browser_->Screenshot(Shot("phone-changes"));
  ASSERT_TRUE(browser_->Type("//input[@name='since']", "lately\xEE\x80\x87"));  // Enter
  ASSERT_TRUE(browser_->WaitForText("'lately': expected a day (monday, ")) << browser_->Text();
  (void)browser_->Run("window.location.hash = 'routes/since=0s'");
  ASSERT_TRUE(browser_->WaitForText("Nothing was changed since ")) << browser_->Text();
  ASSERT_TRUE(browser_->Click("//a[. = '30 days']"));
  // By what it is called now.
  ASSERT_TRUE(browser_->Click("//tr[contains(., 'stored hall@1')]//a[. = 'aisle']"))
      << browser_->Text();
  ASSERT_TRUE(browser_->WaitForText("Changed in the last 30 days")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), HasSubstr("night-shift: close aisle 1..2"));
}

TEST_F(ConsoleRoutesTest, APictureThatIsChosenOrDroppedTellsWhereItWasTaken) {
  const auto scout =
      RunAgent(With(TeachWords(Walk("taught", kTaughtFrames), "scout.db"), {"--server"}));
  ASSERT_EQ(scout.status, 0) << scout.output;
  WriteWalk(folder_ / "later", 1, 160, 120, 60);
  const std::string picture =
      std::filesystem::directory_iterator(folder_ / "later")->path().string();
  Open("routes");
  ASSERT_TRUE(browser_->WaitForText("1 of 1")) << browser_->Text();
  // Until the server has looked through what it was just given.
  const std::string found = "segment ";
  const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
  while (browser_->Text().find(found) == std::string::npos) {
    ASSERT_LT(std::chrono::steady_clock::now(), until) << browser_->Text();
    ASSERT_TRUE(browser_->Type("//input[@accept='image/*']", picture));
    ASSERT_TRUE(WaitForAnswer()) << browser_->Text();
  }
  EXPECT_THAT(browser_->Text(), HasSubstr("hall"));
  browser_->Screenshot(Shot("phone-where"));
  Open("history");
  ASSERT_TRUE(browser_->WaitForText("Commands")) << browser_->Text();
  Open("routes");
  ASSERT_TRUE(browser_->WaitForText("1 of 1")) << browser_->Text();
  EXPECT_THAT(browser_->Text(), Not(HasSubstr(found)));
  (void)browser_->Run(
      "const canvas = document.createElement('canvas'); canvas.width = canvas.height = 64;"
      "canvas.toBlob((blob) => { const files = new DataTransfer();"
      "files.items.add(new File([blob], 'blank.png', {type: 'image/png'}));"
      "document.querySelector('.finder').dispatchEvent("
      "new DragEvent('drop', {bubbles: true, cancelable: true, dataTransfer: files})); });");
  ASSERT_TRUE(browser_->WaitForText("shows too little to be recognised")) << browser_->Text();
}

TEST_F(ConsoleRoutesTest, APersonSeesWhoWasSentWhereAndWhoToldWhomWhat) {
  // The robot is out of reach: a server keeps what it is sent to do.
  const json trip{{"orders", "follow hall laps 2"}, {"id", "trip"}, {"unheard", true}};
  ASSERT_EQ(Post("/api/robots/robot1/missions", trip).status, 200);
  EXPECT_EQ(Post("/api/robots/robot1/stop", {{"reason", "wet floor"}}).status, 504);
  Open("history");
  ASSERT_TRUE(browser_->WaitForText("follow hall laps 2")) << browser_->Text();
  ASSERT_TRUE(browser_->Click("//button[contains(., 'follow hall')]"));
  ASSERT_TRUE(browser_->WaitForText("Sent by console")) << browser_->Text();
  browser_->Screenshot(Shot("phone-history"));
  ASSERT_TRUE(browser_->Click("//nav[@aria-label='Of what']/a[2]"));
  // Not still what was open of the mission.
  ASSERT_TRUE(WaitUntil([&] {
    const std::string text = browser_->Text();
    return text.find("Sent by") == text.npos && text.find("wet floor") != text.npos;
  })) << browser_->Text();
  EXPECT_THAT(browser_->Text(), HasSubstr("nobody answered"));
  browser_->Look(1280, 800);
  browser_->Screenshot(Shot("desktop-commands"));
  ASSERT_TRUE(browser_->Type("//input[@name='robot']", "robot2\xEE\x80\x87"));
  ASSERT_TRUE(browser_->WaitForText("There is none.")) << browser_->Text();
}

}  // namespace
}  // namespace trailcast::test
