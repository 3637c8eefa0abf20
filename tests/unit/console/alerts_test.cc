#include "services/console/alerts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/console/alert_file.h"
#include "tests/support/temp_dir.h"

namespace trailcast::console {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Cause Failed(const std::string& robot, const std::string& reason = "Mission failed: LOST") {
  return {.kind = "failed",
          .subject = robot,
          .alarm = true,
          .reason = reason,
          .place = "7.1 m of hall",
          .action = "Look."};
}

json Open(const Alerts& alerts) { return json::parse(alerts.OpenShown().dump()); }
json All(const Alerts& alerts) { return json::parse(alerts.AllShown().dump()); }

TEST(Alerts, BeginWithTheirCauseAndEndWithIt) {
  Alerts alerts;
  alerts.Note({Failed("robot1")}, {"robot1", "robot2"}, {}, 1000);
  ASSERT_EQ(Open(alerts).size(), 1U);
  EXPECT_EQ(Open(alerts)[0]["robot"], "robot1");
  EXPECT_EQ(Open(alerts)[0]["server"], nullptr);
  EXPECT_EQ(Open(alerts)[0]["severity"], "alarm");
  EXPECT_EQ(Open(alerts)[0]["since_unix_ms"], 1000);
  EXPECT_EQ(Open(alerts)[0]["acknowledged_by"], nullptr);
  const std::uint64_t changes = alerts.changes();
  alerts.Note({Failed("robot1")}, {"robot1", "robot2"}, {}, 2000);
  EXPECT_EQ(alerts.changes(), changes) << "it is as it was";
  alerts.Note({Failed("robot1", "Mission failed: no power")}, {"robot1"}, {}, 3000);
  EXPECT_EQ(Open(alerts)[0]["reason"], "Mission failed: no power");
  EXPECT_EQ(Open(alerts)[0]["since_unix_ms"], 1000) << "the same cause, in other words";
  alerts.Note({}, {"robot1"}, {}, 4000);
  EXPECT_EQ(Open(alerts), json::array());
  EXPECT_EQ(All(alerts)[0]["ended_unix_ms"], 4000);
  alerts.Note({Failed("robot1")}, {"robot1"}, {}, 5000);
  ASSERT_EQ(All(alerts).size(), 2U) << "once more";
  EXPECT_EQ(All(alerts)[0]["since_unix_ms"], 5000) << "the newest first";
}

TEST(Alerts, WhoAcknowledgedFirstStaysNamed) {
  Alerts alerts;
  alerts.Note({Failed("robot1")}, {"robot1"}, {}, 1000);
  const std::string id = Open(alerts)[0]["alert"];
  ASSERT_TRUE(alerts.Acknowledge(id, "anna", 2000));
  ASSERT_TRUE(alerts.Acknowledge(id, "bob", 3000));
  EXPECT_EQ(Open(alerts)[0]["acknowledged_by"], "anna");
  EXPECT_EQ(Open(alerts)[0]["acknowledged_unix_ms"], 2000);
  EXPECT_EQ(alerts.Acknowledge("robot9.failed.1", "anna", 4000).error().code, ErrorCode::kNotFound);
  alerts.Note({}, {"robot1"}, {}, 5000);
  EXPECT_EQ(alerts.Acknowledge(id, "anna", 6000).error().code, ErrorCode::kNotFound) << "ended";
  alerts.Note({Failed("robot1")}, {"robot1"}, {}, 7000);
  EXPECT_EQ(Open(alerts)[0]["acknowledged_by"], nullptr) << "of another one nobody has said so";
}

TEST(Alerts, OfBeforeARestartStayUntilSomethingIsHeard) {
  Alerts before;
  before.Note({Failed("robot1"), Failed("robot2")}, {"robot1", "robot2"}, {}, 1000);
  ASSERT_TRUE(before.Acknowledge(Open(before)[0]["alert"], "anna", 1500));
  auto read = Alerts::Read(before.Text());
  ASSERT_TRUE(read) << read.error().message;
  Alerts after = *std::move(read);
  json expected = Open(before);
  for (json& alert : expected) alert["known"] = false;
  EXPECT_EQ(Open(after), expected);
  after.Note({}, {}, {}, 2000);
  EXPECT_EQ(Open(after).size(), 2U) << "nobody is heard yet";
  after.Note({}, {"robot1", "robot2"}, {"robot1", "robot2"}, 2500);
  EXPECT_EQ(Open(after), expected) << "their missions are not known yet";
  after.Note({Failed("robot1")}, {"robot1", "robot2"}, {}, 3000);
  ASSERT_EQ(Open(after).size(), 1U);
  EXPECT_EQ(Open(after)[0]["robot"], "robot1");
  EXPECT_EQ(Open(after)[0]["since_unix_ms"], 1000);
  EXPECT_EQ(Open(after)[0]["known"], true);
  EXPECT_TRUE(after.End("robot1", 4000)) << "it is listed no more";
  EXPECT_FALSE(after.End("robot1", 5000));
  EXPECT_EQ(Open(after), json::array());
}

TEST(Alerts, ThoseThatHaveEndedMakeRoomTheOldestFirst) {
  Alerts alerts;
  alerts.Note({Failed("robot2")}, {"robot2"}, {}, 1);
  for (std::size_t i = 0; i < Alerts::kMostEnded + 10; ++i) {
    const auto unix_ms = static_cast<std::int64_t>(10 + 2 * i);
    alerts.Note({Failed("robot1")}, {"robot1"}, {}, unix_ms);
    alerts.Note({}, {"robot1"}, {}, unix_ms + 1);
  }
  const json all = All(alerts);
  ASSERT_EQ(all.size(), Alerts::kMostEnded + 1);
  EXPECT_EQ(all.back()["robot"], "robot2") << "an open one stays, however old";
  EXPECT_EQ(all[all.size() - 2]["since_unix_ms"], 30);
}

TEST(Alerts, WhatIsNoneOfThemIsRefused) {
  for (const char* text : {"", "[]", "{}", R"({"alerts": 1})", R"({"alerts": [1]})",
                           R"({"alerts": [{"alert": "a", "kind": "failed"}]})",
                           R"({"alerts": [{"alert": "a", "kind": "b", "robot": "../x"}]})"}) {
    EXPECT_EQ(Alerts::Read(text).error().code, ErrorCode::kCorrupt) << text;
  }
}

TEST(AlertFile, KeepsTheLatestThatItIsGiven) {
  const test::TempDir folder;
  const auto path = folder.path() / "alerts.json";
  Alerts alerts;
  {
    const auto file = AlertFile::Open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(All((*file)->alerts()), json::array());
    for (int i = 1; i <= 20; ++i) {
      alerts.Note({Failed("robot1", std::to_string(i))}, {"robot1"}, {}, 1000);
      (*file)->Keep(alerts.Text());
    }
  }
  const auto again = AlertFile::Open(path);
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(Open((*again)->alerts()).size(), 1U);
  EXPECT_EQ(Open((*again)->alerts())[0]["reason"], "20");
}

TEST(AlertFile, SaysWhatIsWrongWithAFile) {
  const test::TempDir folder;
  std::ofstream(folder.path() / "notes") << "buy milk";
  const auto other = AlertFile::Open(folder.path() / "notes");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("notes"));
  EXPECT_FALSE(AlertFile::Open(folder.path() / "nowhere" / "alerts.json"));
}

}  // namespace
}  // namespace trailcast::console
