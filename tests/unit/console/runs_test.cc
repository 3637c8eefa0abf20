// Logs of runs, listed and opened over HTTP.
#include "services/console/runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "agent/diagnosis/run_mcap.h"
#include "services/console/web.h"
#include "services/exchange/in_process_exchange.h"
#include "services/fleet/routes/route_export.h"
#include "tests/support/await.h"
#include "tests/support/recorded/sample_run.h"
#include "tests/support/temp_dir.h"
#include "tests/support/walk_frames.h"
#include "tests/unit/console/replied.h"

namespace trailcast::console {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string Drive(int frames) {
  test::SampleRun run;
  run.HandOver(0, 8).Frames(frames).Phase(agent::Phase::kBlind, "nothing in view").Frames(10);
  return run.End("ARRIVED", "at its end").Mcap();
}

class RunsTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "logs/robot2");
    Open(folder_ / "logs");
  }
  void Open(const fs::path& folder) {
    web_.reset();
    runs_ = std::make_unique<Runs>(folder);
    web_ = Web::Open(desk_, atlas_, nullptr, "localhost", 0, {}, {}, {}, runs_.get()).value();
  }
  // Long ago, so that nobody takes it for one that is written to.
  void Write(const std::string& name, const std::string& text, int minutes_ago = 60) {
    const fs::path file = folder_ / ("logs/" + name);
    std::ofstream(file, std::ios::binary) << text;
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(minutes_ago));
  }
  [[nodiscard]] httplib::Client Client() const {
    return ClientOf(web_->port(), std::chrono::seconds(30));
  }
  [[nodiscard]] Replied Get(const std::string& path) const {
    return console::ReplyOf(Client().Get(path));
  }
  // Once it has been read.
  [[nodiscard]] Replied Read(const std::string& path) const {
    Replied now;
    test::Await([&] { return (now = Get(path)).status != 202; }, "a log to be read");
    return now;
  }
  [[nodiscard]] json List(const std::string& query = "") const {
    Replied now;
    test::Await(
        [&] {
          now = Get("/api/runs" + query);
          return now.status != 200 || now.body["unread"] == 0;
        },
        "all logs to be looked at");
    EXPECT_EQ(now.status, 200) << now.body;
    return now.body["runs"];
  }
  [[nodiscard]] std::string IdOf(const std::string& file) const {
    for (const json& run : List()) {
      if (run["file"] == file) return run["run"];
    }
    return "none";
  }

  test::TempDir folder_;
  exchange::InProcessBus bus_;
  Desk desk_{AgentId("desk"), bus_.Open(ConsoleTopics())};
  Atlas atlas_{[this]() -> Result<fleet::OperatorPeer> {
    return fleet::OperatorPeer{AgentId("desk-map"), bus_.Open(fleet::ExporterTopics())};
  }};
  std::unique_ptr<Runs> runs_;
  std::unique_ptr<Web> web_;
};

TEST_F(RunsTest, WhatLiesInTheFolderIsListed) {
  Write("old.mcap", Drive(30), 90);
  Write("robot2/new.mcap", Drive(50), 60);
  Write("of-others.mcap", "2026-11-26 a line of something else\n");
  Write("picture.png", Drive(30));
  const json runs = List();
  ASSERT_EQ(runs.size(), 2U) << runs;
  EXPECT_EQ(runs[0]["file"], "robot2/new.mcap");
  EXPECT_EQ(runs[0]["robot"], "robot2");
  EXPECT_EQ(runs[0]["route"], "hall");
  EXPECT_EQ(runs[0]["state"], "ARRIVED");
  EXPECT_EQ(runs[0]["reason"], "at its end");
  EXPECT_NEAR(runs[0]["lasted_s"].get<double>(), 6.0, 0.01);
  EXPECT_FALSE(runs[0]["under_way"]);
  EXPECT_EQ(List("?robot=robot2").size(), 2U);
  EXPECT_EQ(List("?robot=robot3").size(), 0U);
  EXPECT_EQ(List("?skip=1").size(), 1U);
  EXPECT_EQ(List("?mission=m1").size(), 0U);
  EXPECT_EQ(Get("/api/runs?folder=/etc").status, 400);
  EXPECT_EQ(Get("/api/runs?skip=-1").status, 400);
}

TEST_F(RunsTest, APageEndsWhereTheNextBegins) {
  for (int i = 0; i < 60; ++i) Write("run" + std::to_string(i) + ".mcap", Drive(1), 60 + i);
  (void)List();
  const json first = Get("/api/runs").body;
  EXPECT_EQ(first["runs"].size(), Runs::kMostAPage);
  EXPECT_EQ(first["next"], Runs::kMostAPage);
  const json second = Get("/api/runs?skip=" + std::to_string(Runs::kMostAPage)).body;
  EXPECT_EQ(second["runs"].size(), 10U);
  EXPECT_EQ(second["next"], 0);
}

TEST_F(RunsTest, ARunIsOpenedWithWhatExplainSays) {
  Write("run.mcap", Drive(300));
  const std::string path = "/api/runs/" + IdOf("run.mcap");
  const Replied run = Read(path);
  ASSERT_EQ(run.status, 200) << run.body;
  EXPECT_EQ(run.body["rows"], 311);
  EXPECT_FALSE(run.body["pictures"]);
  EXPECT_EQ(run.body["story"]["outcome"], "ARRIVED: at its end");
  EXPECT_THAT(run.body["story"]["happened"].dump(), HasSubstr("blind"));
  const json& strip = run.body["strip"];
  EXPECT_EQ(strip["unit"], "m");
  EXPECT_NEAR(strip["length"].get<double>(), 12.4, 0.1);
  const json& cells = strip["cells"];
  EXPECT_LE(cells["at"].size(), 402U);
  EXPECT_EQ(cells["at"].size(), cells["sure"].size());
  EXPECT_EQ(cells["row"].front(), 0);
  EXPECT_EQ(cells["sure"].front(), 3);
  EXPECT_EQ(cells["sure"].back(), 1);
  EXPECT_EQ(strip["marks"][0]["what"], "hand-over");
  EXPECT_EQ(Read(path + "?along=seconds").body["strip"]["unit"], "s");
  EXPECT_EQ(Get(path + "?along=furlongs").status, 400);

  const Replied frames = Read(path + "/frames?first=300");
  ASSERT_EQ(frames.status, 200);
  ASSERT_EQ(frames.body["frames"].size(), 11U);
  EXPECT_EQ(frames.body["frames"][5]["phase"], "blind");
  EXPECT_THAT(frames.body["frames"][5]["says"].dump(), HasSubstr("nothing in view"));
  EXPECT_EQ(Read(path + "/frames?first=0").body["frames"].size(), 100U);
  EXPECT_EQ(Read(path + "/frames?first=311").status, 404);
  EXPECT_EQ(Get(path + "/frames?first=x").status, 400);
  EXPECT_EQ(Read(path + "/frames/3/seen").body["features"].size(), 0U);
  EXPECT_EQ(Read(path + "/frames/999999999/seen").status, 404);
  EXPECT_EQ(Read(path + "/frames/3/picture").status, 404);
  EXPECT_EQ(Get("/api/runs/0123456789abcdef").status, 404);
}

std::string DriveWithPictures() {
  agent::Fields header;
  header.Add("robot", "robot2");
  header.Add("mission", "m1");
  agent::RunMcap mcap(0.5);
  mcap.Add({.header = header});
  for (int i = 0; i < 20; ++i) {
    agent::FrameRow row;
    row.frame = i;
    row.t_s = 0.1 * i;
    replay::FeatureView feature;
    feature.at = {.u_px = 10.0F, .v_px = -20.0F};
    feature.verdict = replay::FeatureVerdict::kAsksLeft;
    mcap.Add({.stamp = milliseconds(100 * i),
              .row = row,
              .picture = test::WalkFrame(i),
              .features = {feature}});
  }
  mcap.End();
  const auto bytes = mcap.TakeBytes();
  return {bytes.begin(), bytes.end()};
}

TEST_F(RunsTest, PicturesAndFeaturesAreSeenFrameByFrame) {
  Write("run.mcap", DriveWithPictures());
  ASSERT_EQ(List("?mission=m1").size(), 1U);
  const std::string path = "/api/runs/" + IdOf("run.mcap");
  EXPECT_TRUE(Read(path).body["pictures"]);
  const json seen = Read(path + "/frames/7/seen").body;
  EXPECT_EQ(seen["features"], json::parse(R"([[90.0, 40.0, 80.0, 60.0, "left"]])"));
  EXPECT_EQ(seen["picture"], 5);
  EXPECT_NEAR(seen["picture_age_s"].get<double>(), 0.2, 1e-3);
  const auto picture = Client().Get(path + "/frames/5/picture");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_THAT(picture->body, StartsWith("\xff\xd8"));
}

TEST_F(RunsTest, NothingOutsideOfTheFolderIsOpened) {
  std::ofstream(folder_ / "secret.mcap") << Drive(30);
  fs::create_directory(folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere/run.mcap") << Drive(30);
  fs::create_symlink(folder_ / "secret.mcap", folder_ / "logs/link.mcap");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "logs/there");
  ASSERT_EQ(mkfifo((folder_ / "logs/pipe.mcap").c_str(), 0600), 0);
  Write("robot2/run.mcap", Drive(30));
  const json runs = List();
  ASSERT_EQ(runs.size(), 1U) << runs;
  for (const char* wish : {"..%2fsecret.mcap", "../secret.mcap", "link.mcap", "/etc/passwd"}) {
    EXPECT_GE(Get(std::string("/api/runs/") + wish).status, 400) << wish;
  }

  // A person who may write there puts a link in the place of what was found.
  const RunFolder folder(folder_ / "logs");
  const auto found = folder.Scan();
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), 1U);
  EXPECT_TRUE(folder.Open(found->front()));
  fs::remove_all(folder_ / "logs/robot2");
  EXPECT_FALSE(folder.Open(found->front()));
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "logs/robot2");
  EXPECT_FALSE(folder.Open(found->front()));
  fs::remove(folder_ / "logs/robot2");
  fs::create_directory(folder_ / "logs/robot2");
  fs::create_symlink(folder_ / "secret.mcap", folder_ / "logs/robot2/run.mcap");
  EXPECT_FALSE(folder.Open(found->front()));
  const std::string id = runs[0]["run"];
  EXPECT_EQ(Read("/api/runs/" + id).status, 404);
}

TEST_F(RunsTest, ALogThatIsCutOffOrDamagedSaysSo) {
  const std::string begun = test::SampleRun().HandOver(0, 8).Frames(50).Mcap(false);
  Write("cut.mcap", begun.substr(0, begun.size() - 10));
  std::string damaged = Drive(50);
  const std::size_t second_chunk = damaged.find("zstd", damaged.find("zstd") + 1);
  damaged[second_chunk + 30] = static_cast<char>(damaged[second_chunk + 30] ^ 0x55);
  Write("bytes.mcap", damaged);
  const json cut = Read("/api/runs/" + IdOf("cut.mcap")).body;
  EXPECT_EQ(cut["state"], "");
  EXPECT_THAT(cut["story"]["missing"].dump(), HasSubstr("breaks off"));
  EXPECT_THAT(cut["story"]["missing"].dump(), HasSubstr("\"  at byte "));
  const Replied bytes = Read("/api/runs/" + IdOf("bytes.mcap"));
  ASSERT_EQ(bytes.status, 200);
  EXPECT_THAT(bytes.body["story"]["missing"].dump(), HasSubstr("cannot be read"));
  Write("fresh.mcap", begun, 0);
  (void)List();
  Open(folder_ / "logs");
  EXPECT_TRUE(List()[0]["under_way"]) << "it may be written to, still";
}

TEST_F(RunsTest, ALogOfOnesOwnOpensTheSameWay) {
  Open("");
  EXPECT_EQ(Get("/api/runs").status, 409);
  const auto post = [&](const std::string& bytes) {
    const auto got = Client().Post("/api/runs", bytes, "application/octet-stream");
    return got ? Replied{got->status, json::parse(got->body, nullptr, false)} : Replied{};
  };
  const Replied taken = post(Drive(30));
  ASSERT_EQ(taken.status, 202) << taken.body;
  const std::string path = "/api/runs/" + taken.body["run"].get<std::string>();
  EXPECT_EQ(Read(path).body["rows"], 41);
  const Replied pictured = post(DriveWithPictures());
  EXPECT_TRUE(Read("/api/runs/" + pictured.body["run"].get<std::string>()).body["pictures"]);

  const Replied other = post("no log at all");
  ASSERT_EQ(other.status, 202);
  const Replied refused = Read("/api/runs/" + other.body["run"].get<std::string>());
  EXPECT_EQ(refused.status, 422);
  EXPECT_THAT(refused.body["error"].get<std::string>(), HasSubstr("not a replay's log"));
  EXPECT_THAT(refused.body["error"].get<std::string>(), Not(HasSubstr("/proc")));
  for (std::size_t i = 0; i < Runs::kMostUploads; ++i) EXPECT_EQ(post(Drive(1)).status, 202);
  EXPECT_EQ(Read(path).status, 404) << "the oldest make room";
  const auto huge = Client().Post("/api/runs", {{"Content-Length", "9999999999"}}, "",
                                  "application/octet-stream");
  EXPECT_TRUE(!huge || huge->status >= 400);
}

TEST_F(RunsTest, StrangeLogsHoldUpNobody) {
  agent::RunMcap mcap(0.0);
  agent::RunEvent event{.what = "hand-over"};
  event.fields.Add("segment", "7");
  mcap.Add({.header = agent::Fields(),
            .events = std::vector<agent::RunEvent>(30'000, event),
            .stamp = SensorTime(0)});
  agent::FrameRow row;
  for (row.frame = 0; row.frame < 30'000; ++row.frame) {
    row.segment = row.frame % 2;
    row.phase = row.frame % 3 == 0 ? agent::Phase::kLost : agent::Phase::kSure;
    mcap.Add({.stamp = SensorTime(0), .row = row});
  }
  mcap.End();
  const auto bytes = mcap.TakeBytes();
  Write("strange.mcap", {bytes.begin(), bytes.end()});
  const std::clock_t began = std::clock();
  const Replied run = Read("/api/runs/" + IdOf("strange.mcap"));
  ASSERT_EQ(run.status, 200);
  EXPECT_LE(run.body["strip"]["marks"].size(), 300U);
  EXPECT_LT(run.body.dump().size(), 200'000U);
  EXPECT_LT(std::clock() - began, 30 * CLOCKS_PER_SEC) << "of CPU, on a busy machine, too";
}

}  // namespace
}  // namespace trailcast::console
