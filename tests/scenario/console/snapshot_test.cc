// These test what robots' cameras see, over HTTP and in a browser: while somebody looks, and no
// longer.
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>

#include "services/dds/dds_exchange.h"
#include "services/exchange/messages.h"
#include "services/image/files.h"
#include "tests/scenario/console/console_fleet.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

constexpr std::size_t kMostBytes = 12U << 10U;

class SnapshotTest : public ConsoleFleetTest {
 protected:
  void SetUp() override {
    Teach();
    ASSERT_NO_FATAL_FAILURE(PutOnDuty());
    StartConsole();
  }
  void Send(const std::string& orders) {
    const Replied sent = Post("/api/robots/robot1/missions", {{"orders", orders}});
    ASSERT_EQ(sent.status, 200) << sent.body.dump();
  }
  struct Seen {
    int status = 0;
    std::string body;
    std::string text;
  };
  Seen Look(const std::string& robot = "robot1") {
    const auto got = Client().Get("/api/robots/" + robot + "/snapshot");
    if (!got) return {};
    return {got->status, got->body, got->get_header_value("Trailcast-Seen")};
  }
  // A picture whose words say so, within the time that slow machines need.
  Seen LookUntil(const std::string& text) {
    Seen seen;
    EXPECT_TRUE(WaitUntil([&] {
      seen = Look();
      return seen.status == 200 && seen.text.find(text) != std::string::npos;
    })) << seen.status
        << " " << seen.text << agent_->output();
    return seen;
  }
  static image::RgbImage Decoded(const Seen& seen) {
    EXPECT_LE(seen.body.size(), kMostBytes);
    const std::vector<std::uint8_t> bytes(seen.body.begin(), seen.body.end());
    auto picture = image::DecodeRgb(bytes, "snapshot");
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? *picture : image::RgbImage{};
  }
};

TEST_F(SnapshotTest, ShowsWhatTheCameraSeesFreeAndOnItsWayAndSaysWhenItIsDead) {
  const Seen free = LookUntil("no turn is asked for");
  EXPECT_GT(Decoded(free).width, 0);

  Send("follow hall");
  const Seen first = LookUntil("in their funnel lanes");
  EXPECT_LE(Decoded(first).width, 320);
  Seen second;
  EXPECT_TRUE(WaitUntil([&] {
    second = Look();
    return second.status == 200 && second.body != first.body;
  }));
  EXPECT_NE(Decoded(first).pixels, Decoded(second).pixels) << "it drives";

  const Ended snapshot =
      End(*Start("trailcast", {"snapshot", "robot1", "-o", Path("seen.jpg")}, "snapshot"));
  EXPECT_EQ(snapshot.status, 0) << snapshot.output;
  EXPECT_TRUE(image::ReadRgb(Path("seen.jpg")));

  ASSERT_TRUE(WaitForState("available")) << Robot1().dump(2) << agent_->output();
  EXPECT_EQ(Look("robot7").status, 504);
  robot_->Signal(SIGKILL);
  (void)End(*robot_);
  Seen dead;
  ASSERT_TRUE(WaitUntil([&] {
    dead = Look();
    return dead.status == 404;
  })) << dead.status;
  EXPECT_THAT(dead.body, HasSubstr("camera"));
  ASSERT_TRUE(WaitForState("fault"))
      << "nobody looks at its frames, and it says so all the same: " << Robot1().dump(2);
  EXPECT_THAT(Robot1().value("detail", ""), HasSubstr("camera"));
}

TEST_F(SnapshotTest, NothingIsSentWhileNobodyLooks) {
  dds::DdsOptions options;
  options.self = AgentId("listener");
  options.discovery_tag = tag_;
  options.network_interface = "lo";
  const auto listener =
      dds::OpenDdsExchange(options, {.write = {}, .read = {exchange::Topic::kSnapshots}}).value();
  const auto heard = [&](milliseconds for_so_long) {
    std::size_t snapshots = 0;
    for (const auto until = steady_clock::now() + for_so_long; steady_clock::now() < until;) {
      for (const exchange::Message& message : listener->Take(milliseconds(20))) {
        if (std::holds_alternative<exchange::Snapshot>(message)) ++snapshots;
      }
    }
    return snapshots;
  };
  Send("follow hall");
  ASSERT_TRUE(WaitForState("driving")) << Robot1().dump(2) << agent_->output();
  EXPECT_EQ(heard(milliseconds(1000)), 0U);
  (void)LookUntil("funnel lanes");  // and the topic is met
  EXPECT_TRUE(WaitUntil([&] {
    (void)Look();
    return heard(milliseconds(200)) > 0;
  })) << "whoever listens hears them";
  EXPECT_TRUE(WaitUntil([&] { return heard(milliseconds(2000)) == 0; })) << "nobody looks";
}

TEST_F(SnapshotTest, APersonSeesThePictureWhileItIsOpenInABrowser) {
  if (!Browser::IsThere()) GTEST_SKIP() << "chromium and chromium-driver are not installed";
  Browser browser(folder_ / "");
  ASSERT_TRUE(browser.runs()) << browser.log();
  browser.Look(390, 844);
  browser.Open(Page());
  ASSERT_TRUE(browser.WaitForText("robot1")) << browser.Text();
  const auto asked = [&] {
    const json count = browser.Run(
        "return performance.getEntriesByType('resource').filter("
        "(entry) => entry.name.endsWith('/snapshot')).length");
    return count.is_number() ? count.get<int>() : -1;
  };
  (void)browser.Run("performance.setResourceTimingBufferSize(100000)");
  EXPECT_EQ(asked(), 0) << "nobody has asked to see it";
  Send("follow hall speed 0.25");
  // The page then shows so much of its path that the picture moves out of sight, and it is pulled
  // only while it is seen.
  ASSERT_TRUE(browser.WaitForText("Driving")) << browser.Text() << agent_->output();
  ASSERT_TRUE(browser.Click("//button[contains(., 'Camera')]"));
  ASSERT_TRUE(browser.WaitForText("in their funnel lanes")) << browser.Text() << agent_->output();
  ASSERT_TRUE(browser.WaitForText("Lateral offset")) << browser.Text();
  const json lit = browser.Run(
      "const canvas = document.querySelector('.snapshot canvas');"
      "const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;"
      "return new Set(data).size");
  EXPECT_GT(lit.is_number() ? lit.get<int>() : 0, 50) << "a picture has many shades";
  browser.Screenshot(Shot("phone-camera"));
  browser.Look(1280, 800, true);
  ASSERT_TRUE(browser.WaitForText("in their funnel lanes"));
  browser.Screenshot(Shot("desktop-camera"));

  // Out of view, and closed, it asks no more.
  (void)browser.Run("document.body.style.paddingBottom = '9000px'; window.scrollTo(0, 8000)");
  const auto rests = [&] {
    return WaitUntil([&] {
      const int before = asked();
      std::this_thread::sleep_for(milliseconds(2500));
      return asked() == before;
    });
  };
  EXPECT_TRUE(rests()) << "out of view";
  const int before = asked();
  (void)browser.Run("document.querySelector('.snapshot canvas').scrollIntoView()");
  EXPECT_TRUE(WaitUntil([&] { return asked() > before; })) << "back in view";
  ASSERT_TRUE(browser.Click("//button[contains(., 'Camera')]"));
  EXPECT_TRUE(rests()) << "closed";
}

}  // namespace
}  // namespace trailcast::test
