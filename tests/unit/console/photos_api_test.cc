// Photos of missions over HTTP, from a server's part in this process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "route_server/fleet/photo_registry.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "services/image/files.h"
#include "services/program/presence.h"
#include "services/route/digest.h"
#include "tests/support/await.h"
#include "tests/support/painted_wall.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/console/replied.h"
#include "tests/unit/photos/a_photo.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using photos::Photo;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::StartsWith;

class PhotosApiTest : public testing::Test {
 protected:
  void Serve() { Serve("barn", std::move(folder_)); }
  // Returns once the console hears it.
  void Serve(const std::string& name, std::unique_ptr<photos::PhotoFolder> folder) {
    servers_.emplace_back(
        [this, name, kept = std::move(folder)](const std::stop_token& stop) mutable {
          server::PhotoRegistry registry(AgentId(name), std::move(kept));
          const auto exchange = bus_.Open(program::WithAgents(exchange::ServerTopics()));
          program::Presence presence(*exchange, StatusOf(name));
          while (!stop.stop_requested()) {
            presence.Tick(std::chrono::steady_clock::now());
            for (const exchange::Message& message : exchange->Take(milliseconds(5))) {
              if (const auto* asked = std::get_if<exchange::NetworkRequest>(&message)) {
                (void)exchange->Publish(registry.Answer(*asked));
              } else if (const auto* wants = std::get_if<exchange::PhotoRequest>(&message)) {
                if (const auto piece = registry.Give(*wants)) (void)exchange->Publish(*piece);
              }
            }
          }
        });
    AwaitServer(name);
  }
  static exchange::AgentStatus StatusOf(const std::string& name) {
    return {.agent = AgentId(name),
            .instance = 1,
            .role = exchange::AgentRole::kServer,
            .mode = exchange::AgentMode::kWaiting};
  }
  void AwaitServer(const std::string& name) {
    test::Await(
        [&] {
          const json servers = Get("/api/state").body["servers"];
          return std::any_of(servers.begin(), servers.end(),
                             [&](const json& each) { return each["name"] == name; });
        },
        "the server is heard");
  }
  // A photo of the wall by a mission, whose name's first letter is its id's digits, too.
  void Keep(const std::string& mission, const image::GrayImage& picture) {
    KeepIn(*folder_, mission, picture);
  }
  static void KeepIn(photos::PhotoFolder& folder, const std::string& mission,
                     const image::GrayImage& picture) {
    const auto jpeg = image::EncodeJpeg(picture, 90).value();
    const Photo photo{.id = std::string(16, mission[0]),
                      .robot = AgentId("robot2"),
                      .mission = mission,
                      .route = "hall",
                      .revision = 1,
                      .along_m = 12.53,
                      .spot_m = 12.5,
                      .place = "shelf",
                      .taken_unix_ms = 1'700'000'000'000 + mission[0],
                      .width_px = picture.width,
                      .height_px = picture.height,
                      .bytes = static_cast<std::uint32_t>(jpeg.size()),
                      .digest = route::Sha256(jpeg)};
    ASSERT_TRUE(folder.Add(photo, jpeg));
  }
  static image::GrayImage Wall(unsigned seed, double shift_px) {
    return test::PaintedWall(seed).Photograph(
        {.scale = 1.4, .du_px = shift_px, .width = 640, .height = 480});
  }
  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(60));
  }
  [[nodiscard]] Replied Get(const std::string& path) const { return ReplyOf(Client().Get(path)); }

  static const std::string kA;  // photos' ids
  static const std::string kB;

  test::TempDir place_;
  std::unique_ptr<photos::PhotoFolder> folder_ =
      photos::PhotoFolder::Open(place_ / "photos", 10'000'000).value();
  exchange::InProcessBus bus_;
  std::vector<std::jthread> servers_;
  Desk desk_{AgentId("desk-p7"), bus_.Open(ConsoleTopics()),
             Desk::Options{.reply_within = milliseconds(20'000)}};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Web> web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}).value();
};
const std::string PhotosApiTest::kA(16, 'a');
const std::string PhotosApiTest::kB(16, 'b');

TEST_F(PhotosApiTest, AreListedAndShownWithTheOtherVisitsOfTheirPlace) {
  Keep("a1", Wall(1, 0.0));
  Keep("b1", Wall(1, 10.0));
  Serve();
  const json all = Get("/api/photos").body;
  ASSERT_EQ(all["photos"].size(), 2U) << all;
  EXPECT_EQ(all["photos"][0]["id"], kB) << "the last taken first";
  EXPECT_EQ(all["photos"][0]["server"], "barn");
  EXPECT_EQ(all["next"], 0);
  EXPECT_EQ(Get("/api/photos?mission=a1").body["photos"].size(), 1U);
  EXPECT_EQ(Get("/api/photos?place=shelf").body["photos"].size(), 2U);
  EXPECT_EQ(Get("/api/photos?place=hall@12.6").body["photos"].size(), 2U);
  EXPECT_EQ(Get("/api/photos?place=yard@12.6").body["photos"].size(), 0U);
  const json shown = Get("/api/photos/" + kA).body;
  EXPECT_EQ(shown["photo"]["place"], "shelf");
  EXPECT_EQ(shown["photo"]["sure"], true);
  ASSERT_EQ(shown["visits"].size(), 1U) << shown;
  EXPECT_EQ(shown["visits"][0]["mission"], "b1");
}

TEST_F(PhotosApiTest, AreThoseOfAllServersTheLastTakenFirstAndEachOnce) {
  Keep("a1", Wall(1, 0.0));
  Keep("c1", Wall(1, 0.0));
  auto shed = photos::PhotoFolder::Open(place_ / "shed", 10'000'000).value();
  KeepIn(*shed, "b1", Wall(1, 10.0));
  KeepIn(*shed, "c1", Wall(1, 0.0));  // its robot did not hear that the barn has it
  Serve();
  Serve("shed", std::move(shed));
  const json all = Get("/api/photos").body;
  std::vector<std::string> missions;
  for (const json& photo : all["photos"]) missions.push_back(photo["mission"]);
  EXPECT_THAT(missions, testing::ElementsAre("c1", "b1", "a1"));
  EXPECT_EQ(all["silent"], json::array());
  EXPECT_EQ(Get("/api/photos?first=1").body["photos"].size(), 2U);
  EXPECT_EQ(Get("/api/photos/" + kA).body["visits"].size(), 2U);
  for (const std::string& id : {kA, kB}) {
    EXPECT_EQ(Client().Get("/api/photos/" + id + "/picture")->status, 200);
  }
  EXPECT_THAT(Client().Get("/api/photos.tar")->body, HasSubstr("-bbbb.jpg"));
  EXPECT_THAT(Get("/api/photos?first=20000").error(), HasSubstr("only the last 20000"));
}

TEST_F(PhotosApiTest, PagesOfAllServersHaveEachPhotoOnce) {
  constexpr std::size_t kPhotos = 230;  // of each server
  const auto fill = [&](photos::PhotoFolder& folder, std::size_t odd) {
    for (std::size_t i = 0; i < kPhotos; ++i) {
      const auto jpeg = photos::SomeJpeg(10);
      photos::Photo photo = photos::APhoto('a', jpeg);
      photo.id = fmt::format("{:016x}", 2 * i + odd);
      photo.taken_unix_ms += static_cast<std::int64_t>(2 * i + odd);
      ASSERT_TRUE(folder.Add(photo, jpeg));
    }
  };
  auto shed = photos::PhotoFolder::Open(place_ / "shed", 10'000'000).value();
  fill(*folder_, 0);
  fill(*shed, 1);
  Serve();
  Serve("shed", std::move(shed));
  std::vector<std::string> ids;
  std::uint32_t first = 0;
  do {
    const json page = Get("/api/photos?first=" + std::to_string(first)).body;
    for (const json& photo : page["photos"]) ids.push_back(photo["id"]);
    first = page["next"];
  } while (first > 0 && ids.size() < 3 * kPhotos);
  ASSERT_EQ(ids.size(), 2 * kPhotos);
  EXPECT_TRUE(std::is_sorted(ids.rbegin(), ids.rend())) << "the last taken first";
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
}

TEST_F(PhotosApiTest, SayWhichServerIsHeardAndDoesNotAnswer) {
  Keep("a1", Wall(1, 0.0));
  Serve();
  const auto mute = bus_.Open(program::WithAgents(exchange::ServerTopics()));
  const std::jthread speaks([&](const std::stop_token& stop) {
    program::Presence presence(*mute, StatusOf("mute"));
    while (!stop.stop_requested()) {
      presence.Tick(std::chrono::steady_clock::now());
      (void)mute->Take(milliseconds(5));
    }
  });
  AwaitServer("mute");
  const json page = Get("/api/photos").body;
  EXPECT_EQ(page["photos"].size(), 1U);
  EXPECT_EQ(page["silent"], json::array({"mute"}));
  const Replied folder = Get("/api/photos.tar");
  EXPECT_EQ(folder.status, 503);
  EXPECT_THAT(folder.error(), HasSubstr("route server mute does not answer"));
  const Replied other = Get("/api/photos/" + kB);
  EXPECT_EQ(other.status, 503) << "it may have that one";
  EXPECT_THAT(other.error(), HasSubstr("route server mute does not answer"));
}

TEST_F(PhotosApiTest, ArePicturesAndAFolderWithATable) {
  Keep("a1", Wall(1, 0.0));
  Keep("b1", Wall(1, 10.0));
  Serve();
  const auto picture = Client().Get("/api/photos/" + kA + "/picture");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->status, 200);
  EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  const std::vector<std::uint8_t> bytes(picture->body.begin(), picture->body.end());
  EXPECT_EQ(image::DecodeGray(bytes, "it")->width, 640);
  const auto tar = Client().Get("/api/photos.tar?mission=a1");
  ASSERT_TRUE(tar);
  EXPECT_EQ(tar->body.size() % 512, 0U);
  EXPECT_THAT(tar->body, StartsWith("photos/2023-11-14T22-13-20Z-shelf-robot2-aaaa.jpg"));
  EXPECT_THAT(tar->body, HasSubstr(picture->body));
  EXPECT_THAT(tar->body, HasSubstr("photos/photos.csv"));
  EXPECT_THAT(tar->body, HasSubstr("2023-11-14T22-13-20Z-shelf-robot2-aaaa.jpg,"
                                   "2023-11-14T22:13:20Z,robot2,a1,hall,1,shelf,12.50,12.53,1,0,"));
  EXPECT_EQ(Get("/api/photos.tar?mission=none").status, 404);
}

TEST_F(PhotosApiTest, AreComparedOrItIsSaidWhyNot) {
  image::GrayImage now = Wall(1, 10.0);
  for (int y = 200; y < 260; ++y) {
    for (int x = 300; x < 380; ++x) now.pixels[image::PixelIndex(x, y, now.width)] = 255;
  }
  Keep("a1", Wall(1, 0.0));
  Keep("b1", now);
  Keep("c1", Wall(2, 0.0));
  Serve();
  const json compared = Get("/api/photos/" + kB + "/changes?since=" + kA).body;
  EXPECT_EQ(compared["aligned"], true) << compared;
  ASSERT_EQ(compared["changes"].size(), 1U) << compared;
  EXPECT_NEAR(compared["changes"][0]["x"].get<double>(), 300, 12);
  const auto earlier = Client().Get("/api/photos/" + kB + "/earlier?since=" + kA);
  ASSERT_TRUE(earlier);
  EXPECT_EQ(earlier->get_header_value("Content-Type"), "image/jpeg");
  const json other = Get("/api/photos/" + std::string(16, 'c') + "/changes?since=" + kA).body;
  EXPECT_EQ(other["aligned"], false);
  EXPECT_THAT(other["why"].get<std::string>(), HasSubstr("do not align"));
  EXPECT_EQ(Get("/api/photos/" + std::string(16, 'c') + "/earlier?since=" + kA).status, 409);
}

TEST_F(PhotosApiTest, ThatAreNotThereAndQuestionsThatAreNoneAreRefusedInWords) {
  Keep("a1", Wall(1, 0.0));
  Serve();
  const Replied none = Get("/api/photos/" + kB);
  EXPECT_EQ(none.status, 404);
  EXPECT_THAT(none.error(), HasSubstr("there is no photo"));
  EXPECT_EQ(Get("/api/photos/" + kB + "/picture").status, 404);
  EXPECT_EQ(Get("/api/photos/" + kA + "/changes?since=yesterday").status, 400);
  EXPECT_EQ(Get("/api/photos/" + kA + "/changes?since=" + kB).status, 404);
  EXPECT_THAT(Get("/api/photos?colour=red").error(), HasSubstr("'colour'"));
  EXPECT_THAT(Get("/api/photos?place=hall@").error(), HasSubstr("is no place"));
}

}  // namespace
}  // namespace trailcast::console
